// The lack of memory travels as std::bad_alloc inside the library, also where a library of C reports it, and becomes an Error
// where a function ends that applications call.
#pragma once

#include <exception>
#include <new>
#include <string_view>
#include <type_traits>

#include "capture_format/result.h"

namespace strata {

/// "this machine has too little memory to read smoke.strata". Where there is none for the sentence either, it is shorter.
Error out_of_memory(std::string_view verb, std::string_view file) noexcept;

/// A thread that the system refuses to start, as an error.
Error no_thread(const std::exception& refused);

/// Returns what work() returns, or that error where it throws std::bad_alloc.
template <typename Work>
std::invoke_result_t<Work> within_memory(std::string_view verb, std::string_view file, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return out_of_memory(verb, file);
    }
}

}  // namespace strata
