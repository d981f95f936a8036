// An EXR file that is made in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <ImfIO.h>

namespace strata {

/// OpenEXR passes on a lack of memory as an exception of its own, and not at all where it writes the end of a file in a
/// destructor: these bytes know.
class ExrBytes : public Imf::OStream {
public:
    ExrBytes() : OStream("memory") {}
    void write(const char* bytes, int count) override {
        lacks_memory_ = true;
        const std::size_t end = at_ + static_cast<std::size_t>(count);
        if (end > file_.size()) file_.resize(end);
        file_.replace(at_, static_cast<std::size_t>(count), bytes, static_cast<std::size_t>(count));
        at_ = end;
        lacks_memory_ = false;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override { at_ = at; }

    /// Throws std::bad_alloc where a part of the file got no memory.
    std::string take() {
        if (lacks_memory_) throw std::bad_alloc();
        return std::move(file_);
    }
    /// Throws std::bad_alloc if that is what an exception of OpenEXR's is about; those of its threads have the text alone.
    void rethrow_lack_of_memory(const std::exception& problem) const {
        const bool is_of_thread = std::string_view(problem.what()).find("bad_alloc") != std::string_view::npos;
        if (lacks_memory_ || is_of_thread) throw std::bad_alloc();
    }

private:
    std::string file_;
    std::size_t at_ = 0;
    bool lacks_memory_ = false;
};

}  // namespace strata
