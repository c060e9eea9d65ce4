// Strict JSON for scene files: parsing with positions in messages, and a reader that knows where in the file it is.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace elastoon {

using Json = nlohmann::ordered_json;

/// Parses text. Errors give line and column. Refused besides bad syntax: a key that stands twice in an object, nesting
/// deeper than 64, numbers beyond the range of a double.
Result<Json> parseJson(std::string_view text, const std::string& file);

/// Reads values out of a JSON tree and keeps the first error, with the JSON path of its place. After an error every
/// read gives a default, so callers ask once, at the end.
class JsonReader {
public:
    explicit JsonReader(std::string file) : file_(std::move(file)) {}

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    [[nodiscard]] bool failed() const { return error_.has_value(); }
    void fail(const std::string& path, const std::string& message);

    /// Checks that `value` is an object with no keys but these.
    bool object(const Json& value, const std::string& path, std::span<const std::string_view> keys);
    bool object(const Json& value, const std::string& path, std::initializer_list<std::string_view> keys) {
        return object(value, path, std::span<const std::string_view>(keys.begin(), keys.size()));
    }
    bool array(const Json& value, const std::string& path);

    /// The member of an object, or null where it has none.
    [[nodiscard]] static const Json* member(const Json& value, std::string_view key);
    /// The member, or an error that it is missing.
    const Json* required(const Json& value, const std::string& path, std::string_view key);

    double number(const Json& value, const std::string& path, double least, double most, std::string_view unit = {});
    std::string text(const Json& value, const std::string& path);
    bool boolean(const Json& value, const std::string& path);
    Vec3 vector(const Json& value, const std::string& path, double most);
    Quat rotation(const Json& value, const std::string& path);
    /// "#rrggbb" as sRGB 0..1.
    Vec3 color(const Json& value, const std::string& path);
    /// Index of the word among the choices.
    std::size_t choice(const Json& value, const std::string& path, std::span<const std::string_view> choices);

private:
    std::string file_;
    std::optional<Error> error_;
};

/// The key as part of a JSON path: "/" before it, "~" and "/" in it escaped (RFC 6901).
[[nodiscard]] std::string pathPart(std::string_view key);
[[nodiscard]] std::string pathPart(std::size_t index);

/// The words with commas between them.
[[nodiscard]] std::string listOf(std::span<const std::string_view> words);

/// The known word that is nearest to a mistyped one, as " (did you mean ...?)", or nothing.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> known);

} // namespace elastoon
