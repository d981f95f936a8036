// Files of a test: a path that is gone afterwards, whole files as bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/file_text.h"

namespace strata {

/// A path in the temporary directory, named after the running test; the file is removed at the end.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& name = "capture.strata") {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string unique = std::string(test->test_suite_name()) + "." + test->name() + "." + name;
        for (char& letter : unique) letter = letter == '/' ? '_' : letter;
        path_ = std::filesystem::path(testing::TempDir()) / unique;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline std::vector<std::byte> read_file(const std::filesystem::path& path) {
    const std::string text = file_text(path);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

inline void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

}  // namespace strata
