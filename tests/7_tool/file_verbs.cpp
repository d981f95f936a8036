#include "tests/7_tool/file_verbs.h"

namespace strata {
namespace {

constexpr FileVerb table[] = {
    {"info", "info", "", ".strata", true},
    {"validate", "validate", "", ".strata", false},
    {"replay", "replay", "-o out", ".strata", true},
    {"accept", "accept", "", ".strata", false},
    {"graph", "graph", "", ".strata", true},
    {"report", "report", "--repeats 1 --sweep pool=2 -o report.txt", ".strata", true},
    {"compare", "compare", "bad.json", ".json", false},
    {"bench", "bench voxel", "--repeats 1 --only two -o bench.json", ".strata", true},
    {"spectra", "spectra", "--modes 3 -o spectra.json", ".strata", true},
    {"diff", "diff", "--use transparency/weighted --limit 1000 -o pictures --junit junit.xml", ".strata", true},
    {"probe", "probe", "--at 8,4 --techniques sorted_lists --depths 16 -o probed", ".strata", true},
    {"inspect", "inspect", "--size 400x300 --script /dev/null", ".strata", true},
    {"export_deep", "export --deep --transmittance mean -o made.exr", "", ".strata", true},
    {"export_gltf", "export --gltf -o made.glb", "", ".strata", true},
    {"export_json", "export --json -o made.json", "", ".strata", true},
    {"export_image", "export --image color -o made.exr", "", ".strata", true},
    {"import_gltf", "import", "-o made.strata", ".glb", false},
    {"import_deep", "import --deep", "-o made.strata", ".exr", false},
};

constexpr const char* every_verb[] = {"list",   "record",  "import", "info",  "validate", "replay",  "accept", "export", "graph",
                                      "report", "compare", "diff",   "probe", "bench",    "spectra", "isa",    "inspect"};

}  // namespace

std::span<const FileVerb> file_verbs() { return table; }

std::span<const char* const> verb_names() { return every_verb; }

std::vector<FileVerb> capture_verbs() {
    std::vector<FileVerb> found;
    for (const FileVerb& verb : table)
        if (verb.extension == ".strata") found.push_back(verb);
    return found;
}

}  // namespace strata
