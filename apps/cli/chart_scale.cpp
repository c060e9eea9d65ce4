// See chart_scale.h.
#include "chart_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

std::string tickLabel(double value, int decimals) {
    const double shown = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
    const std::string text = fmt::format("{:.{}f}", std::abs(shown), decimals);
    return shown < 0.0 ? "\u2212" + text : text;
}

std::vector<ChartTick> decadeTicks(const ChartAxis& axis) {
    std::vector<ChartTick> ticks;
    const int first = static_cast<int>(std::ceil(std::log10(axis.from) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.to) + 1e-9));
    for (int power = first; power <= last; ++power) {
        const bool plain = power >= -3 && power <= 4;
        const std::string label = plain ? tickLabel(std::pow(10.0, power), std::max(0, -power))
                                        : fmt::format("10^{{{}{}}}", power < 0 ? "\u2212" : "", std::abs(power));
        ticks.push_back({std::pow(10.0, power), label});
    }
    return ticks;
}

std::vector<ChartTick> roundTicks(const ChartAxis& axis, int wanted) {
    const double rough = (axis.to - axis.from) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    const double step = power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    std::vector<ChartTick> ticks;
    const double first = std::ceil(axis.from / step - 1e-9);
    for (double i = first; i * step <= axis.to + 1e-9 * step; i += 1.0) {
        ticks.push_back({i * step, tickLabel(i * step, decimals)});
    }
    return ticks;
}

double distanceToSegment(const ChartPoint& p, const ChartPoint& a, const ChartPoint& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    const double along = square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

} // namespace

double ChartScale::at(double value) const {
    const double share = logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
    return begin + share * (end - begin);
}

std::vector<ChartTick> ticksOf(const ChartAxis& axis, int wanted) {
    if (!axis.ticks.empty()) {
        return axis.ticks;
    }
    return axis.logarithmic ? decadeTicks(axis) : roundTicks(axis, wanted);
}

std::vector<double> minorTicksOf(const ChartAxis& axis) {
    std::vector<double> ticks;
    if (!axis.logarithmic) {
        return ticks;
    }
    for (double decade = std::pow(10.0, std::floor(std::log10(axis.from))); decade < axis.to; decade *= 10.0) {
        for (int i = 2; i <= 9; ++i) {
            if (i * decade > axis.from && i * decade < axis.to) {
                ticks.push_back(i * decade);
            }
        }
    }
    return ticks;
}

std::vector<ChartPoint> simplified(const std::vector<ChartPoint>& line, double tolerance) {
    if (line.size() < 3) {
        return line;
    }
    std::vector<bool> kept(line.size(), false);
    kept.front() = kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        double widest = tolerance;
        std::size_t split = first;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double distance = distanceToSegment(line[i], line[first], line[last]);
            if (distance > widest) {
                widest = distance;
                split = i;
            }
        }
        if (split != first) {
            kept[split] = true;
            open.push_back({first, split});
            open.push_back({split, last});
        }
    }
    std::vector<ChartPoint> result;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (kept[i]) {
            result.push_back(line[i]);
        }
    }
    return result;
}

} // namespace elastoon
