// See report.h.
#include "report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace elastoon {

namespace {

void printCell(const std::string& text, const Column& column) {
    if (column.format.empty()) {
        fmt::print("{:<{}}", text, column.width);
    } else {
        fmt::print("{:>{}}", text, column.width);
    }
}

std::string textOf(const Value& value, const Column& column) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        return *text;
    }
    const double number = std::get<double>(value);
    return std::isnan(number) ? "-" : fmt::format(fmt::runtime(column.format), number);
}

} // namespace

void Report::begin(Table table) {
    tables_.push_back(std::move(table));
}

void Report::add(std::vector<Value> row) {
    const Table& table = tables_.back();
    const auto& columns = table.columns;
    if (table.rows.empty()) {
        fmt::print("\n{}\n", table.title);
        for (const Column& column : columns) {
            printCell(column.name, column);
        }
        fmt::print("\n");
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
        printCell(textOf(row[i], columns[i]), columns[i]);
    }
    fmt::print("\n");
    std::fflush(stdout);
    tables_.back().rows.push_back(std::move(row));
}

bool Report::empty() const {
    return std::all_of(tables_.begin(), tables_.end(), [](const Table& table) { return table.rows.empty(); });
}

void Report::expectAtLeast(std::string what, double value, double limit) {
    bounds_.push_back({std::move(what), value, limit, true, false});
}

void Report::expectAtMost(std::string what, double value, double limit) {
    bounds_.push_back({std::move(what), value, limit, false, false});
}

void Report::errorAtMost(std::string what, double value, double limit) {
    bounds_.push_back({std::move(what), value, limit, false, true});
}

bool Report::judge(Speeds speeds) const {
    bool all = true;
    double worst_error = 0.0;
    int errors = 0;
    fmt::print("\nBounds\n");
    for (const Bound& bound : bounds_) {
        if (bound.is_error) {
            ++errors;
            worst_error = std::fmax(worst_error, bound.value);
        }
        if (bound.is_error ? bound.holds() : speeds == Speeds::Hidden) {
            continue;
        }
        fmt::print("{:<5} {}: {:.3g}, must be at {} {:g}\n", bound.holds() ? "ok" : "SHORT", bound.what, bound.value,
                   bound.at_least ? "least" : "most", bound.limit);
        all = all && (bound.holds() || (!bound.is_error && speeds != Speeds::Judged));
    }
    fmt::print("{} errors of ours looked at, the largest {:.1e}\n", errors, worst_error);
    return all;
}

nlohmann::json Report::asJson() const {
    auto tables = nlohmann::json::array();
    for (const Table& table : tables_) {
        if (table.rows.empty()) {
            continue;
        }
        auto rows = nlohmann::json::array();
        for (const auto& row : table.rows) {
            auto object = nlohmann::json::object();
            for (std::size_t i = 0; i < row.size(); ++i) {
                std::visit([&](const auto& value) { object[table.columns[i].name] = value; }, row[i]);
            }
            rows.push_back(std::move(object));
        }
        tables.push_back({{"title", table.title}, {"rows", std::move(rows)}});
    }
    auto bounds = nlohmann::json::array();
    for (const Bound& bound : bounds_) {
        bounds.push_back({{"what", bound.what},
                          {"value", bound.value},
                          {bound.at_least ? "at_least" : "at_most", bound.limit},
                          {"holds", bound.holds()},
                          {"is_error", bound.is_error}});
    }
    return {{"compiler", __VERSION__}, {"tables", std::move(tables)}, {"bounds", std::move(bounds)}};
}

} // namespace elastoon
