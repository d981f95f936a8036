#include "replay/cli/verb.h"

namespace strata {

std::function<Result<void>()> declare_list(CLI::App&);
std::function<Result<void>()> declare_record(CLI::App&);
std::function<Result<void>()> declare_import(CLI::App&);
std::function<Result<void>()> declare_export(CLI::App&);
std::function<Result<void>()> declare_info(CLI::App&);
std::function<Result<void>()> declare_validate(CLI::App&);
std::function<Result<void>()> declare_replay(CLI::App&);
std::function<Result<void>()> declare_accept(CLI::App&);
std::function<Result<void>()> declare_graph(CLI::App&);
std::function<Result<void>()> declare_report(CLI::App&);
std::function<Result<void>()> declare_compare(CLI::App&);
std::function<Result<void>()> declare_bench(CLI::App&);
std::function<Result<void>()> declare_spectra(CLI::App&);
std::function<Result<void>()> declare_diff(CLI::App&);
std::function<Result<void>()> declare_probe(CLI::App&);
std::function<Result<void>()> declare_isa(CLI::App&);
std::function<Result<void>()> declare_isa_compile(CLI::App&);

std::span<const Verb> verbs() {
    static constexpr Verb table[] = {
        {"list", "list stages, techniques with their parameters, and scenarios", declare_list},
        {"record", "record the frames of a built-in scenario", declare_record},
        {"import", "convert a glTF scene or a deep OpenEXR image to a capture", declare_import},
        {"export", "export a frame for other programs: deep image, images, glTF, JSON", declare_export},
        {"info", "show what a capture contains and which stages its frames need", declare_info},
        {"validate", "check every byte and every index of a capture", declare_validate},
        {"replay", "run every pass of the frames again and write the images", declare_replay},
        {"accept", "store this replay's results as the capture's expected results", declare_accept},
        {"graph", "show the frame graph: steps, barriers, memory, and why stages are skipped", declare_graph},
        {"report", "measure error and time of every technique of a stage", declare_report},
        {"compare", "compare two reports: cost at equal error, error at equal cost, row by row", declare_compare},
        {"bench", "measure the speed-ups that a technique's source claims, or what the device can do", declare_bench},
        {"spectra", "find the cheapest set of shader variants for the tiles of these frames", declare_spectra},
        {"diff", "compare two captures, settings, devices or images", declare_diff},
        {"probe", "show the fragments of one pixel and each technique's transmittance along its ray", declare_probe},
        {"isa", "compile every pipeline for a GPU and show registers, occupancy and modeled times", declare_isa},
        {"isa-compile", "compile what strata isa asks for", declare_isa_compile},
    };
    return table;
}

}  // namespace strata
