// Compiles all shaders in one process: nearly all that a call of glslangValidator takes is parsing the functions that are built
// into GLSL, which are the same for every shader (232 shaders: 110 s of CPU by calls, 2 s here, and the same bytes).
//   compile_shaders NAMES SOURCES SPIRV FOLDER...
// For each name in the file NAMES, a line each, SOURCES/name becomes SPIRV/name.spv; includes are looked for in the folders. Then
// the file SPIRV/compiled is made anew, and SPIRV/compiled.d says what it depends on.
// Exit code: 0, or 1 with the compiler's words on standard error.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

namespace {

namespace fs = std::filesystem;

constexpr auto messages = static_cast<EShMessages>(EShMsgDefault | EShMsgSpvRules | EShMsgVulkanRules);

bool read(const fs::path& path, std::string& text) {
    std::ifstream file(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), {});
    return file.good();
}

/// Finds what shaders include, in the folders alone, and keeps the names of all that it read.
class Includes : public glslang::TShader::Includer {
public:
    explicit Includes(std::vector<fs::path> folders) : folders_(std::move(folders)) {}

    /// Asked for includes in quotes, too.
    IncludeResult* includeSystem(const char* name, const char*, std::size_t) override {
        for (const fs::path& folder : folders_) {
            auto text = std::make_unique<std::string>();
            const fs::path path = folder / name;
            if (!fs::is_regular_file(path) || !read(path, *text)) continue;
            read_files_.insert(path.string());
            const std::string& kept = *text;
            return new IncludeResult(path.string(), kept.data(), kept.size(), text.release());
        }
        return nullptr;
    }
    void releaseInclude(IncludeResult* result) override {
        if (!result) return;
        delete static_cast<std::string*>(result->userData);
        delete result;
    }

    const std::set<std::string>& read_files() const { return read_files_; }

private:
    std::vector<fs::path> folders_;
    std::set<std::string> read_files_;
};

EShLanguage language_of(const fs::path& source) {
    const std::string kind = source.extension().string();
    if (kind == ".vert") return EShLangVertex;
    if (kind == ".geom") return EShLangGeometry;
    return kind == ".frag" ? EShLangFragment : EShLangCompute;
}

/// As glslangValidator --target-env vulkan1.3 does.
bool compile(const fs::path& source, const fs::path& spirv, Includes& includes) {
    std::string text;
    if (!read(source, text)) {
        std::fprintf(stderr, "cannot read %s\n", source.c_str());
        return false;
    }
    const EShLanguage language = language_of(source);
    glslang::TShader shader(language);
    const std::string name = source.string();
    const char *code = text.c_str(), *said_of = name.c_str();
    shader.setStringsWithLengthsAndNames(&code, nullptr, &said_of, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    glslang::TProgram program;
    if (!shader.parse(GetDefaultResources(), 100, false, messages, includes)) {
        std::fprintf(stderr, "%s", shader.getInfoLog());
        return false;
    }
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) {
        std::fprintf(stderr, "%s", program.getInfoLog());
        return false;
    }
    std::vector<unsigned int> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(language), words, &options);
    std::ofstream file(spirv, std::ios::binary);
    file.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(words[0])));
    if (!file.flush()) std::fprintf(stderr, "cannot write %s\n", spirv.c_str());
    return file.good();
}

}  // namespace

int main(int count, char** words) {
    const std::vector<std::string> arguments(words + 1, words + count);
    std::string names;
    if (arguments.size() < 4 || !read(arguments[0], names)) return EXIT_FAILURE;
    const fs::path sources(arguments[1]), outputs(arguments[2]), compiled = outputs / "compiled";
    Includes includes({arguments.begin() + 3, arguments.end()});
    std::ofstream depfile(outputs / "compiled.d");
    depfile << compiled.string() << ':';
    bool is_good = true;
    glslang::InitializeProcess();
    std::istringstream lines(names);
    for (std::string name; std::getline(lines, name);) {
        const fs::path source = sources / name;
        depfile << " \\\n " << source.string();
        is_good &= compile(source, outputs / (name + ".spv"), includes);
    }
    glslang::FinalizeProcess();
    for (const std::string& file : includes.read_files()) depfile << " \\\n " << file;
    depfile << '\n';
    if (!is_good || !depfile.flush()) return EXIT_FAILURE;
    return std::ofstream(compiled) << names ? EXIT_SUCCESS : EXIT_FAILURE;
}
