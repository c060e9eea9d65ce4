// Interleaved timing: every contender runs a block in every round, so that what else the machine does hits all alike.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace elastoon {

/// One block of one contender.
struct Job {
    std::function<void()> work;
    std::size_t items = 1; ///< that one call of `work` does
    std::function<void()> prepare = nullptr; ///< before each call of `work`, if there is one: takes no time
};

/// How long a cell of a table is measured.
struct Effort {
    double seconds = 1.0;
    int least_rounds = 9;
    int most_rounds = 400;
    bool quick = false; ///< few cases, one round: for errors, not for times
};

/// ns of CPU time per item, a vector for each job; element r of each is from round r.
[[nodiscard]] std::vector<std::vector<double>> interleave(std::span<const Job> jobs, const Effort& effort);

[[nodiscard]] double median(std::vector<double> values);
/// Element by element.
[[nodiscard]] std::vector<double> difference(std::span<const double> a, std::span<const double> b);
/// Median of a[r] / b[r].
[[nodiscard]] double medianRatio(std::span<const double> a, std::span<const double> b);

/// The larger; infinite where the error is no number.
[[nodiscard]] double worst(double so_far, double error);

/// What the program was asked to do, for every table.
struct Choice {
    Effort effort;
    bool large = false; ///< the cells of a million bodies, too
    std::string filter; ///< cells whose name holds it
    [[nodiscard]] bool wants(const std::string& cell) const { return cell.find(filter) != std::string::npos; }
};

} // namespace elastoon
