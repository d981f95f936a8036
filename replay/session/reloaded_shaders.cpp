// Shaders compiled while the program runs, in the place of those built in.
#include "replay/glsl/compile_glsl.h"
#include "replay/session/device_session.h"

namespace strata {

const std::vector<std::uint32_t>* DeviceSession::compiled_before(const std::string& shader, std::uint64_t hash) const {
    if (shader_sets_.empty()) return nullptr;
    const auto& compiled = shader_sets_.back()->compiled;
    const auto known = compiled.find(shader);
    return known != compiled.end() && known->second.hash == hash ? &known->second.code : nullptr;
}

Result<std::unique_ptr<DeviceSession::ShaderSet>> DeviceSession::compile_set(const GlslSources& sources,
                                                                             ReloadedShaders& reloaded) const {
    auto set = std::make_unique<ShaderSet>();
    std::vector<std::string> changed;
    const GlslSources built_in = GlslSources::built_in();
    for (const std::string& name : ShaderLibrary::built_in().names()) {
        const std::uint64_t hash = sources.hash_of(name);
        if (hash == built_in.hash_of(name)) continue;
        reloaded.replaced.push_back(name);
        const auto* code = compiled_before(name, hash);
        if (!code) changed.push_back(name);
        set->compiled[name] = {hash, code ? *code : std::vector<std::uint32_t>()};
    }
    auto codes = compile_glsl(sources, changed, stop_);
    if (!codes) return codes.error();
    for (std::size_t i = 0; i < changed.size(); ++i) set->compiled[changed[i]].code = std::move((*codes)[i]);
    for (const auto& [name, compiled] : set->compiled) {
        auto shader = reflect(name, compiled.code);
        if (!shader) return shader.error();
        set->library.add(*std::move(shader));
    }
    reloaded.compiled = changed.size();
    return set;
}

Result<ReloadedShaders> DeviceSession::reload_shaders(const std::filesystem::path& folder, std::span<const Request> shown) {
    const auto sources = GlslSources::of(folder);
    if (!sources) return sources.error();
    ReloadedShaders reloaded;
    auto set = compile_set(*sources, reloaded);
    if (!set) return set.error();
    shader_sets_.push_back(*std::move(set));
    for (const Request& request : shown) {
        const auto planned = plan(request);
        if (planned) continue;
        shader_sets_.pop_back();
        return planned.error();
    }
    remembered_.clear();  // other shaders made it
    return reloaded;
}

}  // namespace strata
