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
std::function<Result<void>()> declare_bench(CLI::App&);
std::function<Result<void>()> declare_spectra(CLI::App&);
std::function<Result<void>()> declare_diff(CLI::App&);
std::function<Result<void>()> declare_probe(CLI::App&);
std::function<Result<void>()> declare_isa(CLI::App&);
std::function<Result<void>()> declare_isa_compile(CLI::App&);

std::span<const Verb> verbs() {
    static constexpr Verb table[] = {
        {"list", "stages, techniques with their parameters, scenarios", declare_list},
        {"record", "run a scenario and record its frames", declare_record},
        {"import", "make a capture of a glTF scene or a deep image", declare_import},
        {"export", "one thing of a frame for other programs: deep image, images, glTF, JSON", declare_export},
        {"info", "what is in a capture, and what its frames call for", declare_info},
        {"validate", "check every byte and every index of a capture", declare_validate},
        {"replay", "run every pass again; write EXR, PNG and JSON", declare_replay},
        {"accept", "write down what a replay gave as what is expected from now on", declare_accept},
        {"graph", "the plan of a frame: steps, barriers, memory, what is left out and why", declare_graph},
        {"report", "every technique of a stage: error against time", declare_report},
        {"bench", "the ratios of times that a technique states, measured here", declare_bench},
        {"spectra", "what lit tiles need, and the shading modes that serve them at the least cost", declare_spectra},
        {"diff", "two captures, settings, devices or images: what differs, where, by how much", declare_diff},
        {"probe", "one pixel: its fragments in order, and T(z) of every method beside the exact steps", declare_probe},
        {"isa", "what a GPU's compiler makes of every pipeline: registers, waves and what limits them, modelled times",
         declare_isa},
        {"isa-compile", "compile what strata isa asks for", declare_isa_compile},
    };
    return table;
}

}  // namespace strata
