// Temporaries are created, renamed and removed under one lock, and a thread of its own waits for the signals that end the
// program: with the lock in its hand it knows every temporary there is. A signal handler could not, it may not wait for a lock.
#include "capture_format/container/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "capture_format/container/file.h"
#include "capture_format/container/kept_files.h"
#include "capture_format/out_of_memory.h"

namespace strata {
namespace {

// With Pending::first, the kept files and the stop the only thing of this program that is global and changes: a signal comes to
// the process and brings no arguments. None has a destructor, so a signal during exit() finds them, too.
constinit std::mutex lock;
constinit std::stop_source* stop_at_signal = nullptr;

/// What keep_files() was given. Every file of the program is written through begin(), and few writers know what a verb reads.
std::vector<std::filesystem::path>& kept_files() {
    static auto* const kept = new std::vector<std::filesystem::path>;
    return *kept;
}

Error unwritable(const std::filesystem::path& path, int problem) {
    return fail(Fault::usage, "file.cannot_write", "cannot write {file}: {reason}", path.string(),
                std::generic_category().message(problem));
}

/// An empty file beside the target that was not there before, so that nobody's link is followed.
Result<std::filesystem::path> make_beside(const std::filesystem::path& target) {
    constexpr std::size_t longest_stem = 200;  // of the 255 bytes a name may have
    const std::string stem = target.filename().string().substr(0, longest_stem);
    for (unsigned number = 0;; ++number) {
        std::filesystem::path path = target.parent_path() / fmt::format("{}.{}-{}.tmp", stem, ::getpid(), number);
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST) continue;
        if (descriptor < 0) return unwritable(target, errno);
        ::close(descriptor);
        return path;
    }
}

}  // namespace

/// A temporary and its place in the list of all that a signal must remove.
struct WholeFile::Pending {
    std::filesystem::path target, temporary;
    bool in_place = false;  ///< there is no temporary: the target is no file
    Pending *before = nullptr, *after = nullptr;
    static constinit Pending* first;

    Pending(std::filesystem::path wanted, std::filesystem::path written)
        : target(std::move(wanted)), temporary(std::move(written)) {}
    Pending(const Pending&) = delete;
    Pending& operator=(const Pending&) = delete;
    ~Pending();
    void enlist();
};

constinit WholeFile::Pending* WholeFile::Pending::first = nullptr;

/// The lock is held.
void WholeFile::Pending::enlist() {
    after = first;
    if (after) after->before = this;
    first = this;
}

WholeFile::Pending::~Pending() {
    if (in_place) return;
    const std::scoped_lock held(lock);
    ::unlink(temporary.c_str());  // after commit() there is no such file
    (before ? before->after : first) = after;
    if (after) after->before = before;
}

WholeFile::WholeFile(std::unique_ptr<Pending> pending) : pending_(std::move(pending)) {}
WholeFile::WholeFile(WholeFile&&) noexcept = default;
WholeFile& WholeFile::operator=(WholeFile&&) noexcept = default;
WholeFile::~WholeFile() = default;

void keep_files(std::vector<std::filesystem::path> files) {
    const std::scoped_lock held(lock);
    kept_files() = std::move(files);
}

Result<void> check_not_kept(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none)) return {};
    const std::scoped_lock held(lock);
    for (const std::filesystem::path& kept : kept_files()) {
        if (std::filesystem::equivalent(kept, path, none))
            return fail(Fault::usage, "file.is_input", "cannot write {file}: it is the input {input}. Choose another output",
                        path.string(), kept.string());
    }
    return {};
}

Result<WholeFile> WholeFile::begin(const std::filesystem::path& wanted) {
    if (const auto free = check_not_kept(wanted); !free) return free.error();
    struct stat old {};
    const bool exists = ::stat(wanted.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) return unwritable(wanted, EISDIR);
    if (exists && ::access(wanted.c_str(), W_OK) != 0) return unwritable(wanted, errno);
    if (exists && !S_ISREG(old.st_mode)) {
        auto pending = std::make_unique<Pending>(wanted, wanted);
        pending->in_place = true;
        return WholeFile(std::move(pending));
    }
    std::error_code problem;
    const bool is_link = std::filesystem::is_symlink(wanted, problem);
    std::filesystem::path target = is_link ? std::filesystem::weakly_canonical(wanted, problem) : wanted;
    std::error_code none;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(target, none); ++links)  // to no file yet
        target = target.parent_path() / std::filesystem::read_symlink(target, none);
    if (is_link && problem) return unwritable(wanted, problem.value());

    const std::scoped_lock held(lock);
    auto pending = std::make_unique<Pending>(std::move(target), std::filesystem::path());
    pending->in_place = true;  // until there is a temporary: without memory for its place in the list none is made
    Result<std::filesystem::path> temporary = make_beside(pending->target);
    if (!temporary) return temporary.error();
    pending->temporary = *std::move(temporary);
    pending->in_place = false;
    if (exists) ::chmod(pending->temporary.c_str(), old.st_mode & 0777);
    pending->enlist();
    return WholeFile(std::move(pending));
}

const std::filesystem::path& WholeFile::temporary() const {
    assert(pending_ && "the file was committed");
    return pending_->temporary;
}

std::unique_lock<std::mutex> WholeFile::hold_signals() { return std::unique_lock(lock); }

StopAtSignal::StopAtSignal() {
    const std::scoped_lock held(lock);
    assert(!stop_at_signal && "one at a time");
    stop_at_signal = &source_;
}

StopAtSignal::~StopAtSignal() {
    const std::scoped_lock held(lock);
    stop_at_signal = nullptr;
}

Result<void> WholeFile::commit() {
    assert(pending_ && "the file was committed");
    const std::unique_ptr<Pending> done = std::move(pending_);
    if (done->in_place) return {};
    const std::scoped_lock held(lock);
    if (::rename(done->temporary.c_str(), done->target.c_str()) != 0) return unwritable(done->target, errno);
    return {};
}

Result<void> write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    Result<WholeFile> file = WholeFile::begin(path);
    if (!file) return file.error();
    Result<GrowingFile> writing = GrowingFile::extend(file->temporary());
    if (!writing) return writing.error();
    if (const Result<void> written = writing->append(bytes); !written) return written;
    return file->commit();
}

Result<void> write_whole_file(const std::filesystem::path& path, std::string_view text) {
    return write_whole_file(path, std::as_bytes(std::span(text)));
}

void end_program(int code) {
    lock.lock();  // for good: no writer goes on
    for (const WholeFile::Pending* each = WholeFile::Pending::first; each; each = each->after) ::unlink(each->temporary.c_str());
    _exit(code);
}

Result<void> leave_nothing_half_written_when_stopped() {
    static bool waits = false;  // one thread does
    if (waits) return {};
    sigset_t stops;
    sigemptyset(&stops);
    // What a terminal, a batch system or a limit of the processor's time sends to end a program.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2}) {
        struct sigaction inherited {};
        sigaction(signal, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) sigaddset(&stops, signal);
    }
    pthread_sigmask(SIG_BLOCK, &stops, nullptr);
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
    try {
        std::thread([stops] {
            const auto say = [](std::string_view words) {
                [[maybe_unused]] const auto said = ::write(STDERR_FILENO, words.data(), words.size());
            };
            int signal = 0;
            for (;;) {
                sigwait(&stops, &signal);
                lock.lock();  // for good, unless it only asks for a stop: no writer goes on
                const bool asks = stop_at_signal && (signal == SIGINT || signal == SIGTERM);
                if (!asks || !stop_at_signal->request_stop()) break;
                lock.unlock();
                say("strata: stopping; a second signal ends it at once\n");
            }
            for (const WholeFile::Pending* each = WholeFile::Pending::first; each; each = each->after)
                ::unlink(each->temporary.c_str());
            say("strata: interrupted; no file is half written\n");
            _exit(128 + signal);
        }).detach();
        waits = true;
    } catch (const std::system_error& refused) {
        return no_thread(refused);
    }
    return {};
}

}  // namespace strata
