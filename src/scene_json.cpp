// See scene_json.h. The tree is built by hand from the parser's events: the library's own gives no place of an error
// without exceptions, and lets a later key overwrite an earlier one.
#include "scene_json.h"

#include "check_input.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace elastoon {

namespace {

constexpr std::size_t kMostDepth = 64;

class TreeBuilder final : public nlohmann::json_sax<Json> {
public:
    [[nodiscard]] Json take() { return std::move(root_); }
    [[nodiscard]] const std::string& message() const { return message_; }
    [[nodiscard]] std::optional<std::size_t> position() const { return position_; }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& value) override {
        if (open_.back()->contains(value)) {
            message_ = "the key \"" + value + "\" stands twice in one object";
            return false;
        }
        key_ = std::move(value);
        return true;
    }
    bool parse_error(std::size_t position, const std::string& last, const nlohmann::detail::exception& why) override {
        position_ = position;
        const std::string text = why.what();
        message_ = text.find("overflow") != std::string::npos ? "the number " + last + " is too large"
                                                              : "not valid JSON near '" + last.substr(0, 40) + "'";
        return false;
    }

private:
    template <class Value>
    Json* place(Value&& value) {
        if (open_.empty()) {
            root_ = std::forward<Value>(value);
            return &root_;
        }
        Json& parent = *open_.back();
        if (parent.is_array()) {
            parent.push_back(std::forward<Value>(value));
            return &parent.back();
        }
        return &(parent[key_] = std::forward<Value>(value));
    }
    template <class Value>
    bool add(Value&& value) {
        place(Json(std::forward<Value>(value)));
        return true;
    }
    bool open(Json container) {
        if (open_.size() == kMostDepth) {
            message_ = "nested deeper than 64 levels";
            return false;
        }
        open_.push_back(place(std::move(container)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    Json root_;
    std::vector<Json*> open_;
    std::string key_, message_;
    std::optional<std::size_t> position_;
};

std::string placeOf(std::string_view text, std::size_t position) {
    const std::string_view before = text.substr(0, std::min(position, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " +
           std::to_string(std::max<std::size_t>(before.size() - line_begin, 1));
}

std::string kindOf(const Json& value) {
    return std::string(value.is_number()   ? "a number"
                       : value.is_string() ? "a text"
                       : value.is_array()  ? "a list"
                       : value.is_object() ? "an object"
                                           : value.type_name());
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

} // namespace

Result<Json> parseJson(std::string_view text, const std::string& file) {
    TreeBuilder builder;
    if (!Json::sax_parse(text, &builder)) {
        const std::string where = builder.position() ? ": " + placeOf(text, *builder.position()) : "";
        return Error{builder.message(), file + where};
    }
    return builder.take();
}

std::string pathPart(std::string_view key) {
    std::string part = "/";
    for (const char c : key) {
        part += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return part;
}

std::string pathPart(std::size_t index) {
    return "/" + std::to_string(index);
}

std::string listOf(std::span<const std::string_view> words) {
    std::string text;
    for (const std::string_view word : words) {
        text += (text.empty() ? "" : ", ") + std::string(word);
    }
    return text;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
    if (word.size() > 64) {
        return {};
    }
    std::string_view best;
    std::size_t least = 3;
    for (const std::string_view candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best.empty() ? std::string{} : " (did you mean \"" + std::string(best) + "\"?)";
}

void JsonReader::fail(const std::string& path, const std::string& message) {
    if (!error_) {
        const std::string where = file_ + (file_.empty() || path.empty() ? "" : ": ") + path;
        error_ = Error{message, where};
    }
}

bool JsonReader::object(const Json& value, const std::string& path, std::span<const std::string_view> keys) {
    if (!value.is_object()) {
        fail(path, "must be an object, is " + kindOf(value));
        return false;
    }
    for (const auto& [key, unused] : value.items()) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            fail(path + pathPart(key), "unknown key" + suggestion(key, keys) + "; allowed: " + listOf(keys));
            return false;
        }
    }
    return true;
}

bool JsonReader::array(const Json& value, const std::string& path) {
    if (!value.is_array()) {
        fail(path, "must be a list, is " + kindOf(value));
        return false;
    }
    return true;
}

const Json* JsonReader::member(const Json& value, std::string_view key) {
    const auto found = value.find(std::string(key));
    return found == value.end() ? nullptr : &*found;
}

const Json* JsonReader::required(const Json& value, const std::string& path, std::string_view key) {
    const Json* found = member(value, key);
    if (found == nullptr) {
        fail(path, "the key \"" + std::string(key) + "\" is missing");
    }
    return found;
}

double JsonReader::number(const Json& value, const std::string& path, double least, double most,
                          std::string_view unit) {
    if (!value.is_number()) {
        fail(path, "must be a number, is " + kindOf(value));
        return least;
    }
    const double number = value.get<double>();
    if (!(number >= least && number <= most)) {
        fail(path, "must be from " + shortNumber(least) + " to " + shortNumber(most) +
                       (unit.empty() ? "" : " " + std::string(unit)) + ", is " + shortNumber(number));
        return least;
    }
    return number;
}

std::string JsonReader::text(const Json& value, const std::string& path) {
    if (!value.is_string()) {
        fail(path, "must be a text in quotes, is " + kindOf(value));
        return {};
    }
    return value.get<std::string>();
}

Vec3 JsonReader::vector(const Json& value, const std::string& path, double most) {
    if (!value.is_array() || value.size() != 3) {
        fail(path, "must be a list of 3 numbers, is " +
                       (value.is_array() ? "a list of " + std::to_string(value.size()) : kindOf(value)));
        return Vec3(0.0);
    }
    Vec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(axis);
        result[axis] = number(value[index], path + pathPart(index), -most, most);
    }
    return result;
}

Quat JsonReader::rotation(const Json& value, const std::string& path) {
    if (!value.is_array() || value.size() != 4) {
        fail(path, "must be a quaternion: a list of 4 numbers, x y z w");
        return kNoRotation;
    }
    std::array<double, 4> q{};
    double square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        q[i] = number(value[i], path + pathPart(i), -1e6, 1e6);
        square += q[i] * q[i];
    }
    if (square < 1e-12) {
        fail(path, "must be a quaternion x y z w that is not zero; no rotation is [0, 0, 0, 1]");
        return kNoRotation;
    }
    return {q[3], q[0], q[1], q[2]};
}

Vec3 JsonReader::color(const Json& value, const std::string& path) {
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    const auto isHex = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    };
    if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), isHex)) {
        fail(path, "must be a colour like \"#e4572e\"");
        return Vec3(0.0);
    }
    Vec3 result(0.0);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result[static_cast<int>(channel)] = std::stoi(text.substr(1 + 2 * channel, 2), nullptr, 16) / 255.0;
    }
    return result;
}

bool JsonReader::boolean(const Json& value, const std::string& path) {
    if (!failed() && !value.is_boolean()) {
        fail(path, "must be true or false, is " + std::string(value.type_name()));
    }
    return value.is_boolean() && value.get<bool>();
}

std::size_t JsonReader::choice(const Json& value, const std::string& path, std::span<const std::string_view> choices) {
    const std::string word = text(value, path);
    const auto found = std::find(choices.begin(), choices.end(), word);
    if (!failed() && found == choices.end()) {
        fail(path, "must be one of " + listOf(choices) + ", is \"" + word + "\"" + suggestion(word, choices));
    }
    return found == choices.end() ? 0 : static_cast<std::size_t>(found - choices.begin());
}

} // namespace elastoon
