// Whatever a capture says, under checksums that are right: every verb ends with an exit code and a sentence. A forger's capture
// is packed in memory from records (tests/fuzz), and the verbs run in this process, where a crash or a hang ends the test.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "capture_format/container/container.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "captures/scenarios.h"
#include "replay/cli/tool.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/7_tool/process.h"
#include "tests/fuzz/frame_records.h"
#include "tests/fuzz/mutate_record.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

Frame scenario_frame(std::string_view name) {
    const auto scenario = std::ranges::find(scenarios(), name, &Scenario::name);
    return scenario->build(0, {.width = 8, .height = 8});
}

/// What the tool itself expects of a capture, as JSON.
std::string expectation_of_a_replay() {
    EXPECT_EQ(strata("record three_panes --size 8x8 -o seed.strata").code, 0);
    EXPECT_EQ(strata("accept seed.strata").code, 0);
    return must(Capture::open(folder() / "seed.strata")).expectations().at(0);
}

std::vector<std::vector<Record>> seeds() {
    std::vector<std::vector<Record>> all;
    const std::string expectation = expectation_of_a_replay();
    for (const Frame& frame : {rich_frame(), triangle_frame(), scenario_frame("three_panes"), scenario_frame("glass_and_smoke"),
                               scenario_frame("lights_room"), scenario_frame("interface_layers")}) {
        all.push_back(records_of(frame, RecordKind::frame));
        for (const auto& [type, text] : {std::pair(SectionType::expect, expectation), {SectionType::notes, "seen on a bad day"}})
            all.back().push_back({RecordKind::section, static_cast<std::uint8_t>(type), 1, 0, bytes_of(text)});
    }
    return all;
}

/// What a text parser stumbles over, or a few bytes.
void change_bytes(Bytes& bytes, std::minstd_rand& random) {
    constexpr std::array<std::string_view, 12> telling = {
        "null", "1e999", "-1", "\"", "{", "[[[[[[[[", "\\u0000", "\xff\xfe", "18446744073709551616", "\x1b[2J", "", "NaN"};
    if (bytes.empty()) return;
    const std::size_t at = random() % bytes.size();
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random() % 4) {
        case 0: {
            const Bytes text = bytes_of(telling[random() % telling.size()]);
            bytes.erase(place, place + static_cast<std::ptrdiff_t>(std::min<std::size_t>(random() % 12, bytes.size() - at)));
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), text.begin(), text.end());
            return;
        }
        case 1:
            bytes.resize(at);
            return;
        case 2:
            bytes[at] = std::byte(random());
            return;
        default:
            bytes[at] ^= std::byte(1u << random() % 8);
    }
}

/// Standard output and error go nowhere while it lives.
class Silence {
public:
    Silence() : out_(::dup(1)), err_(::dup(2)) {
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, 1);
        ::dup2(nowhere, 2);
        ::close(nowhere);
    }
    ~Silence() {
        ::dup2(out_, 1);
        ::dup2(err_, 2);
        ::close(out_);
        ::close(err_);
    }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    int out_, err_;
};

std::vector<std::string> command_of(std::uint32_t turn, const std::string& file) {
    if (turn % 2000 == 1) return {"replay", file, "--memory-budget", "64MiB"};  // seconds: every one compiles its pipelines
    if (turn % 2 == 0) return {"info", file, "--json", "--memory-budget", "64MiB"};
    return {"validate", file, "--memory-budget", "64MiB"};
}

/// A seed with one to three changes; false where even the writer refuses it.
bool forge(const std::vector<std::vector<Record>>& all, std::uint32_t turn, const std::filesystem::path& file) {
    std::minstd_rand random(turn + 1);
    random.discard(3);
    std::vector<Record> records = all[random() % all.size()];
    const auto change = [&](Bytes& bytes) { change_bytes(bytes, random); };
    for (std::uint32_t i = 0; i <= random() % 3; ++i) mutate_record(records, random, change);
    return seal(records, file);
}

/// Commands that ended well; the others ended with a code below 8.
std::size_t run_verbs(std::uint32_t first, std::uint32_t count) {
    const std::vector<std::vector<Record>> all = seeds();
    const std::filesystem::path file = folder() / "forged.strata";
    std::size_t sound = 0;
    for (std::uint32_t turn = first; turn < first + count; ++turn) {
        if (!forge(all, turn, file)) continue;
        const std::vector<std::string> command = command_of(turn, file.string());
        int code = 0;
        {
            const Silence silence;
            code = run_tool(command, verbs());
        }
        EXPECT_TRUE(code >= 0 && code < 8 && code != 5) << "turn " << turn << ": " << command[0] << " ended with " << code;
        sound += code == 0 ? 1 : 0;
    }
    return sound;
}

/// Replays what opens, in sessions of 50 frames, which share their pipelines. Frames that were replayed, or refused with a
/// sentence.
std::size_t replay_forged(std::uint32_t first, std::uint32_t count) {
    const std::vector<std::vector<Record>> all = seeds();
    const std::filesystem::path file = folder() / "forged.strata";
    std::vector<Frame> frames;
    std::size_t replayed = 0;
    for (std::uint32_t turn = first; turn < first + count; ++turn) {
        if (!forge(all, turn, file)) continue;
        if (const auto capture = Capture::open(file))
            if (auto frame = capture->frame(0); frame && frame->view.width * frame->view.height <= 4096)
                frames.push_back(*std::move(frame));
        if (frames.size() < 50 && turn + 1 < first + count) continue;
        const std::size_t held = frames.size();
        const auto session = must(Session::open(std::exchange(frames, {}), {.memory_budget = 256u << 20}));
        for (std::size_t i = 0; i < held; ++i) {
            const auto run = session->run({.variant = {.frame = i}});
            EXPECT_TRUE(run || run.error().fault != Fault::device_failed)
                << "before turn " << turn << ": " << run.error().sentence;
            ++replayed;
        }
    }
    return replayed;
}

TEST(VerbFuzz, EveryVerbEndsWithACodeWhateverACaptureSays) {
    const std::size_t sound = run_verbs(0, 1000);
    EXPECT_GT(sound, 100u) << "captures that are all refused try little";
    EXPECT_LT(sound, 900u) << "captures that are all sound try little";
}

TEST(ExhaustiveVerbFuzz, EveryVerbEndsWithACodeWhateverACaptureSays) { EXPECT_GT(run_verbs(1000, 99'000), 10'000u); }

TEST(ExhaustiveVerbFuzz, WhatOpensIsReplayedOrRefused) { EXPECT_GT(replay_forged(200'000, 1000), 100u); }

/// The inspector opens what it can and says what it cannot.
TEST(ExhaustiveVerbFuzz, TheInspectorEndsWithACodeWhateverACaptureSays) {
    const std::vector<std::vector<Record>> all = seeds();
    EXPECT_TRUE(write_whole_file(folder() / "look.script", "wait\n"));
    for (std::uint32_t turn = 300'000; turn < 300'050; ++turn) {
        if (!forge(all, turn, folder() / "forged.strata")) continue;
        const int code = strata("inspect forged.strata --script look.script --memory-budget 64MiB").code;
        EXPECT_TRUE(code >= 0 && code < 8 && code != 5) << "turn " << turn << " ended with " << code;
    }
}

}  // namespace
}  // namespace strata
