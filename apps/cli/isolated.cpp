// See isolated.h.
#include "isolated.h"

#include "progress.h"

#include <fmt/format.h>

#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ELASTOON_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ELASTOON_SANITIZED 1
#endif
#endif

namespace elastoon {

namespace {

#ifdef ELASTOON_SANITIZED
constexpr bool kSanitized = true; // they map terabytes
#else
constexpr bool kSanitized = false;
#endif

constexpr int kThrown = 3;
constexpr int kUnsent = 4;

template <class Resource>
void limit(Resource resource, rlim_t soft, rlim_t hard) {
    const rlimit wanted{soft, hard};
    // Where a lower limit holds already, that one stays.
    (void)setrlimit(resource, &wanted);
}

[[noreturn]] void workAndEnd(const std::function<std::string()>& work, const IsolationLimits& limits, int to) {
    // A group of its own: Ctrl-C reaches the parent alone, which ends this one.
    setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) {
        std::signal(signal, SIG_DFL);
    }
    const auto seconds = static_cast<rlim_t>(limits.seconds);
    limit(RLIMIT_CPU, seconds, seconds + 1);
    limit(RLIMIT_CORE, 0, 0);
    if (!kSanitized) {
        limit(RLIMIT_AS, limits.memory, limits.memory);
    }
    // The child's last words would be of use to nobody.
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    std::string answer;
    try {
        answer = work();
    } catch (...) {
        _exit(kThrown);
    }
    for (std::size_t sent = 0; sent < answer.size();) {
        const ssize_t wrote = write(to, answer.data() + sent, answer.size() - sent);
        if (wrote < 0 && errno != EINTR) {
            _exit(kUnsent);
        }
        sent += wrote > 0 ? static_cast<std::size_t>(wrote) : 0;
    }
    // Not exit(): what the parent registered is the parent's to do.
    _exit(0);
}

/// All that comes until the other end closes. False where Ctrl-C came first.
bool receive(int from, std::string& answer) {
    std::array<char, 65536> buffer{};
    for (;;) {
        if (interrupted()) {
            return false;
        }
        pollfd waiting{from, POLLIN, 0};
        if (poll(&waiting, 1, 50) <= 0) {
            continue;
        }
        const ssize_t got = read(from, buffer.data(), buffer.size());
        if (got == 0) {
            return true;
        }
        if (got > 0) {
            answer.append(buffer.data(), static_cast<std::size_t>(got));
        }
    }
}

int stateOf(pid_t process) {
    int state = 0;
    while (waitpid(process, &state, 0) < 0 && errno == EINTR) {
    }
    return state;
}

} // namespace

Result<std::string> runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        return Error{fmt::format("cannot start a process: {}", std::strerror(errno)), ""};
    }
    const pid_t process = fork();
    if (process == 0) {
        workAndEnd(work, limits, ends[1]);
    }
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return Error{fmt::format("cannot start a process: {}", std::strerror(errno)), ""};
    }
    std::string answer;
    const bool received = receive(ends[0], answer);
    close(ends[0]);
    if (!received) {
        kill(process, SIGKILL);
    }
    const int state = stateOf(process);
    if (!received) {
        return Error{"stopped", ""};
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) {
        return answer;
    }
    if (WIFSIGNALED(state) && WTERMSIG(state) == SIGXCPU) {
        return Error{fmt::format("took more than {} s", limits.seconds), ""};
    }
    return Error{WIFEXITED(state) && WEXITSTATUS(state) == kThrown ? "ran out of memory" : "crashed", ""};
}

} // namespace elastoon
