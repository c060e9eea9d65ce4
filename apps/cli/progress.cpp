// See progress.h.
#include "progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace elastoon {

namespace {

std::atomic<bool> interrupt_seen{false};

void onInterrupt(int signal) {
    interrupt_seen = true;
    std::signal(signal, SIG_DFL);
}

} // namespace

Progress::Progress(std::string label, double total)
    : label_(std::move(label)),
      total_(total),
      shown_(isatty(STDERR_FILENO) != 0),
      begun_(std::chrono::steady_clock::now()),
      drawn_(begun_ - std::chrono::seconds(1)) {
    at(0.0);
}

Progress::~Progress() {
    if (shown_) {
        std::fputc('\n', stderr);
    }
}

void Progress::at(double done) {
    const auto now = std::chrono::steady_clock::now();
    const double share = total_ > 0.0 ? std::clamp(done / total_, 0.0, 1.0) : 1.0;
    if (!shown_ || (now - drawn_ < std::chrono::milliseconds(80) && share < 1.0)) {
        return;
    }
    drawn_ = now;
    const double elapsed = std::chrono::duration<double>(now - begun_).count();
    const std::string left = share > 0.02 ? fmt::format("{:4.0f} s left", elapsed * (1.0 - share) / share) : "";
    const auto filled = static_cast<std::size_t>(share * 30.0);
    fmt::print(stderr, "\r{} [{}{}] {:3.0f} %  {:<12}", label_, std::string(filled, '#'), std::string(30 - filled, '.'),
               share * 100.0, left);
    std::fflush(stderr);
}

void catchInterrupts() {
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
    return interrupt_seen;
}

} // namespace elastoon
