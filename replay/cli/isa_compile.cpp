// strata isa-compile: the process in which `strata isa` compiles. Requests come in, a compilation goes out, both as JSON.
#include <iostream>
#include <iterator>
#include <memory>

#include <CLI/CLI.hpp>

#include "replay/cli/verb.h"
#include "replay/isa/compiler.h"
#include "replay/standard_streams.h"

namespace strata {
namespace {

struct IsaCompileArguments {
    std::uint32_t device = 0;
    bool texts = false;
};

Result<void> compile(const IsaCompileArguments& options) {
    const std::string input(std::istreambuf_iterator<char>(std::cin), {});
    const auto requests = pipelines_from_json(input, ShaderLibrary::built_in());
    if (!requests) return requests.error();
    const auto compiled = compile_here(*requests, options.device, options.texts ? CompilerTexts::kept : CompilerTexts::left);
    if (!compiled) return compiled.error();
    write_stdout(as_json(*compiled) + "\n");
    return {};
}

}  // namespace

std::function<Result<void>()> declare_isa_compile(CLI::App& app) {
    const auto options = std::make_shared<IsaCompileArguments>();
    app.group("");  // no part of the help: strata isa starts it
    app.add_option("--device", options->device, "index of the device");
    app.add_flag("--texts", options->texts, "return the disassembly, too");
    return [options] { return compile(*options); };
}

}  // namespace strata
