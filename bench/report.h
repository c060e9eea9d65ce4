// What was measured: tables for people, the same as JSON, and the bounds that it is held to.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <variant>
#include <vector>

namespace elastoon {

/// A number, printed with its column's format; or a text. NaN prints as a dash.
using Value = std::variant<double, std::string>;

struct Column {
    std::string name;
    std::string format; ///< of fmt, for a number
    int width = 10;
};

struct Table {
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<Value>> rows;
};

/// A figure and what it should be. Errors are always judged; speeds where it was asked for.
struct Bound {
    std::string what;
    double value = 0.0;
    double limit = 0.0;
    bool at_least = false; ///< else at most
    bool is_error = false;
    [[nodiscard]] bool holds() const { return at_least ? value >= limit : value <= limit; }
};

/// What becomes of bounds on speed.
enum class Speeds { Hidden, Shown, Judged };

class Report {
public:
    /// Its title and heads are printed with its first row.
    void begin(Table table);
    /// Prints and keeps a row of the table begun last.
    void add(std::vector<Value> row);
    void expectAtLeast(std::string what, double value, double limit);
    void expectAtMost(std::string what, double value, double limit);
    void errorAtMost(std::string what, double value, double limit);
    [[nodiscard]] bool empty() const;
    /// Prints the bounds; true if those that are judged hold.
    [[nodiscard]] bool judge(Speeds speeds) const;
    [[nodiscard]] nlohmann::json asJson() const;

private:
    std::vector<Table> tables_;
    std::vector<Bound> bounds_;
};

} // namespace elastoon
