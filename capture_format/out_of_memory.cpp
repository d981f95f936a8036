#include "capture_format/out_of_memory.h"

namespace strata {

Error out_of_memory(std::string_view verb, std::string_view file) noexcept {
    try {
        return fail(Fault::device_lacks, "machine.out_of_memory", "this machine has too little memory to {verb} {file}", verb,
                    file);
    } catch (const std::bad_alloc&) {
        return {.fault = Fault::device_lacks,
                .sentence = "out of memory",
                .id = "machine.out_of_memory"};  // so short, it needs no memory
    }
}

Error no_thread(const std::exception& refused) {
    return fail(Fault::device_lacks, "machine.no_thread", "this machine cannot start another thread: {reason}", refused.what());
}

}  // namespace strata
