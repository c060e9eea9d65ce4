// How long the parts of a step take, by the host's clock. World::profile().
#pragma once

#include <functional>

namespace elastoon {

/// Adds the time of its life to a figure of the profile, where there is a clock.
class Stopwatch {
public:
    Stopwatch(const std::function<double()>& read, double& seconds)
        : read_(read), seconds_(seconds), begun_(read ? read() : 0.0) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { seconds_ += read_ ? read_() - begun_ : 0.0; }

private:
    const std::function<double()>& read_;
    double& seconds_;
    double begun_;
};

} // namespace elastoon
