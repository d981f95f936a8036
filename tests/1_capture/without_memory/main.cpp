// A program whose memory fails, as failing_allocations.c does it: without_memory VERB FILE FIRST LAST. It goes on after an error
// as an engine does that does not look at it, prints how many allocations there were, and ends with the code of its first error,
// or with 99 where a result is wrong.
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/container/compression.h"
#include "capture_format/export/gltf.h"
#include "capture_format/import/deep.h"
#include "capture_format/import/gltf.h"
#include "capture_format/out_of_memory.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/without_memory/two_frames.h"

namespace strata {
namespace {

/// A function of the preloaded library, which must be there.
template <typename F>
F* preloaded(const char* name) {
    auto* const found = reinterpret_cast<F*>(::dlsym(RTLD_DEFAULT, name));
    if (!found) std::fprintf(stderr, "%s: failing_allocations is not preloaded\n", name), std::exit(98);
    return found;
}

void (*const fail_allocations)(long, long) = preloaded<void(long, long)>("fail_allocations");
void (*const pause_failing)() = preloaded<void()>("pause_failing");
void (*const go_on_failing)() = preloaded<void()>("go_on_failing");
long (*const allocations)() = preloaded<long()>("allocations");

std::optional<Error> first_error;

/// Keeps the first error. What this program allocates to that end does not fail: its own lack of memory is not tested.
template <typename T>
bool keep(const Result<T>& result) {
    pause_failing();
    if (!result && !first_error) first_error = result.error();
    go_on_failing();
    return static_cast<bool>(result);
}

/// A verb has what it needs before memory fails. It returns whether what it got is right, which is asked when memory no longer
/// fails.
using Check = std::function<bool()>;
using Run = std::function<Check()>;

Run record(const std::string& file) {
    auto frames = std::make_shared<std::array<Frame, 2>>(two_frames());
    auto picture =
        std::make_shared<Texture>(Texture{.width = 8, .height = 8, .texels = std::vector<std::byte>(std::size_t{4} * 8 * 8)});
    return [frames, picture, path = std::filesystem::path(file)]() -> Check {
        auto created = Recorder::create(path, {});
        if (!keep(created)) return {};
        Recorder& recorder = *created;
        auto& [whole, parts] = *frames;
        keep(recorder.thumbnail(*picture));
        keep(recorder.record(std::move(whole)));
        recorder.begin_frame(parts.view, parts.time, parts.index, parts.seed);
        for (Texture& texture : parts.textures) recorder.add_texture(std::move(texture));
        for (Mesh& mesh : parts.meshes) recorder.add_mesh(std::move(mesh));
        for (Material& material : parts.materials) recorder.add_material(std::move(material));
        recorder.draws(parts.draws);
        for (Emitter& emitter : parts.emitters) recorder.emitter(std::move(emitter));
        for (Light& light : parts.lights) recorder.light(std::move(light));
        for (const Blocker& blocker : parts.blockers) recorder.add_blocker(blocker);
        for (const Portal& portal : parts.portals) recorder.add_portal(portal);
        recorder.environment(parts.sun, parts.hemisphere, parts.fog, parts.background);
        for (const LightVolume& volume : parts.light_volumes) recorder.light_volume(volume);
        recorder.weather(parts.rain);
        recorder.camera(parts.lens, parts.film);
        for (StageChoice& choice : parts.recorded_with) recorder.stage(std::move(choice));
        keep(recorder.end_frame());
        keep(recorder.flush());
        keep(recorder.finish());
        return {};
    };
}

Run read(const std::string& file) {
    return [path = std::filesystem::path(file)]() -> Check {
        auto capture = Capture::open(path);
        if (!keep(capture)) return {};
        for (std::size_t i = 0; i < 2; ++i) keep(capture->frame(i));
        pause_failing();
        // A capture of which a frame could not be read for lack of memory is as good as before.
        return [capture = std::make_shared<Capture>(*std::move(capture))] {
            const auto wanted = two_frames();
            return bits_of(*capture->frame(0)) == bits_of(wanted[0]) && bits_of(*capture->frame(1)) == bits_of(wanted[1]);
        };
    };
}

Run gltf(const std::string& file) {
    return [path = std::filesystem::path(file)]() -> Check {
        auto scene = GltfScene::open(path, {});
        if (!keep(scene)) return {};
        auto frame = scene->frame(0);
        if (!keep(frame)) return {};
        pause_failing();
        return [frame, path] { return bits_of(*frame) == bits_of(import_gltf(path, {})->frame); };
    };
}

Run deep(const std::string& file) {
    return [path = std::filesystem::path(file)]() -> Check {
        auto image = import_deep(path, {});
        if (!keep(image)) return {};
        pause_failing();
        return [image, path] { return bits_of(image->frame) == bits_of(import_deep(path, {})->frame); };
    };
}

Run write_gltf(const std::string& file) {
    auto frame = std::make_shared<Frame>(two_frames()[0]);
    return [frame, path = std::filesystem::path(file)]() -> Check {
        keep(export_gltf(*frame, path));
        return {};
    };
}

/// Little else than zstd's own allocations, so that each fails also where only a share of all numbers is tried.
Run compress(const std::string&) {
    auto bytes = std::make_shared<std::vector<std::byte>>(100'000, std::byte{7});
    auto packed = std::make_shared<std::array<std::vector<std::byte>, 2>>();
    return [bytes, packed]() -> Check {
        const auto done = within_memory("compress", "bytes", [&]() -> Result<void> {
            const std::array parts{std::span<const std::byte>(*bytes).first(1000),
                                   std::span<const std::byte>(*bytes).subspan(1000)};
            Compression().append((*packed)[0], parts);
            Compression().append((*packed)[1], *bytes);
            std::vector<std::byte> again(bytes->size());
            return decompress((*packed)[0], again);
        });
        if (!keep(done)) return {};
        pause_failing();
        return [bytes, packed] {
            std::vector<std::byte> first(bytes->size()), second(bytes->size());
            return decompress((*packed)[0], first) && decompress((*packed)[1], second) && first == *bytes && second == *bytes;
        };
    };
}

int run(const std::string& verb, const std::string& file, long first, long last) {
    const std::map<std::string, Run (*)(const std::string&)> verbs = {{"compress", compress}, {"record", record},
                                                                      {"read", read},         {"import_gltf", gltf},
                                                                      {"import_deep", deep},  {"export_gltf", write_gltf}};
    const Run work = verbs.at(verb)(file);
    fail_allocations(first, last);
    const Check is_right = work();
    pause_failing();
    std::printf("%ld\n", allocations());
    if (is_right && !is_right()) return 99;
    if (!first_error) return 0;
    std::fprintf(stderr, "%s: %s\n", std::string(first_error->id.text()).c_str(), first_error->sentence.c_str());
    return static_cast<int>(first_error->fault);
}

}  // namespace
}  // namespace strata

int main(int count, char** words) {
    return count == 5 ? strata::run(words[1], words[2], std::atol(words[3]), std::atol(words[4])) : 98;
}
