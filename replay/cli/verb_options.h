// Options that several verbs take, and what they mean.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture_format/partial.h"
#include "capture_format/result.h"
#include "replay/cli/verb.h"
#include "replay/session/session.h"
#include "replay/shell_word.h"
#include "replay/standard_streams.h"

namespace strata {

class Capture;   // capture_format/reader.h
struct Frame;    // capture_format/frame.h
struct Texture;  // capture_format/frame/texture.h

void add_options(CLI::App&, DeviceChoice&);

/// Which capture on which device.
struct OpenOptions {
    std::filesystem::path capture;
    DeviceChoice device;
    bool allow_partial = false;
};
void add_options(CLI::App&, OpenOptions&);
Result<std::unique_ptr<Session>> open(const OpenOptions&);
/// A capture without a device. Both refuse a file without a frame, and say on stderr what of it was left out.
Result<Capture> open_capture(const std::filesystem::path&, Partial, std::uint64_t memory_budget);
/// --memory-budget of verbs that read a file without a device.
void add_memory_budget(CLI::App&, std::uint64_t& bytes);

/// How the frame is made: techniques, settings, forced features, samples.
struct ChoiceOptions {
    std::vector<std::string> uses, sets, force;
    std::uint32_t samples = 0;
};
void add_options(CLI::App&, ChoiceOptions&);
Result<Request> request_of(const ChoiceOptions&);
/// --eye of verbs that move the camera: a text for eye_move_of().
void add_eye(CLI::App&, std::string& eye);

/// "0,4-8" as frame indices below count; empty means all. Fails for frames that do not exist.
Result<std::vector<std::size_t>> frame_indices(const std::string& text, std::size_t count);
/// Makes a folder for output, and those around it, where it is missing.
Result<void> make_folder(const std::filesystem::path&);
/// What was typed, as a line for a shell: a verb with its options in the order of the help.
std::string command_line(const CLI::App& verb);
/// "320x180".
Result<std::pair<std::uint32_t, std::uint32_t>> extent_of(const std::string& text);

/// Display light as a thumbnail.
Texture thumbnail_of(const HostImage& display);
/// A capture's thumbnail: its first frame, replayed at about that size. Without a usable device there is none; a line says so.
Result<std::optional<Texture>> make_thumbnail(const Frame&, const DeviceChoice&);

}  // namespace strata
