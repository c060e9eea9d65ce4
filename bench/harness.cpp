// See harness.h.
#include "harness.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace elastoon {

namespace {

double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void prepare(const Job& job) {
    if (job.prepare) {
        job.prepare();
    }
}

} // namespace

std::vector<std::vector<double>> interleave(std::span<const Job> jobs, const Effort& effort) {
    std::vector<std::vector<double>> samples(jobs.size());
    if (!effort.quick) {
        for (const Job& job : jobs) {
            prepare(job);
            job.work();
        }
    }
    const int most = effort.quick ? 1 : effort.most_rounds;
    const double start = cpuSeconds();
    for (int round = 0; round < most; ++round) {
        if (round >= effort.least_rounds && cpuSeconds() - start > effort.seconds) {
            break;
        }
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            // There and back: nobody always follows the same one.
            const std::size_t index = round % 2 == 0 ? i : jobs.size() - 1 - i;
            prepare(jobs[index]);
            const double before = cpuSeconds();
            jobs[index].work();
            samples[index].push_back(1e9 * (cpuSeconds() - before) / static_cast<double>(jobs[index].items));
        }
    }
    return samples;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
    std::vector<double> result(a.begin(), a.end());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] -= b[i];
    }
    return result;
}

double medianRatio(std::span<const double> a, std::span<const double> b) {
    std::vector<double> ratios(a.begin(), a.end());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        ratios[i] /= b[i];
    }
    return median(std::move(ratios));
}

double worst(double so_far, double error) {
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(so_far, error);
}

} // namespace elastoon
