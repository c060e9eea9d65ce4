// How a call tells of bad input: a value, or a message that says what, where, and what would be right. No exceptions.
#pragma once

#include "elastoon/export.h"

#include <string>
#include <utility>
#include <variant>

namespace elastoon ELASTOON_API {

/// Why a call was refused. `where` is a file, a JSON path or an argument's name, and may be empty.
struct Error {
    std::string message;
    std::string where;

    [[nodiscard]] std::string text() const { return where.empty() ? message : where + ": " + message; }
};

/// Tells that value() was called where there is only an error, through the assertion handler; then ends the program.
[[noreturn]] void resultWithoutValue(const Error& error);

/// Either a T or the Error that says why there is none.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : held_(std::move(value)) {}
    Result(Error error) : held_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return held_.index() == 0; }
    explicit operator bool() const { return ok(); }

    /// The value. Only when ok(): else it tells the error and ends the program.
    [[nodiscard]] T& value() & {
        check();
        return *std::get_if<0>(&held_);
    }
    [[nodiscard]] const T& value() const& {
        check();
        return *std::get_if<0>(&held_);
    }
    T value() && {
        check();
        return std::move(*std::get_if<0>(&held_));
    }

    /// The reason. Only when not ok().
    [[nodiscard]] const Error& error() const { return *std::get_if<1>(&held_); }

private:
    void check() const {
        if (!ok()) {
            resultWithoutValue(error());
        }
    }

    std::variant<T, Error> held_;
};

/// A call that gives nothing back but may be refused.
using Status = Result<std::monostate>;

[[nodiscard]] inline Status success() {
    return std::monostate{};
}

} // namespace elastoon ELASTOON_API
