// See play.h.
#include "play.h"

#include "scene_json.h"

#include <array>

namespace squashout {

using elastoon::Error;
using elastoon::Json;
using elastoon::JsonReader;
using elastoon::pathPart;
using elastoon::Result;

namespace {

constexpr double kMostSteps = 6.0 * 3600.0 * 120.0;
constexpr std::string_view kHexDigits = "0123456789abcdef";

std::uint64_t fromHex(JsonReader& reader, const Json& value, const std::string& path) {
    const std::string text = reader.text(value, path);
    std::uint64_t number = 0;
    for (const char letter : text) {
        const std::size_t digit = kHexDigits.find(letter);
        if (digit == std::string_view::npos || text.size() != 16) {
            reader.fail(path, "must be 16 hexadecimal digits");
            return 0;
        }
        number = number << 4 | digit;
    }
    return number;
}

/// [steps, launch, has_target, axis, target]: the same input for so many steps.
void readRun(JsonReader& reader, const Json& run, const std::string& path, std::vector<PlayInput>& inputs) {
    constexpr std::array<std::array<double, 2>, 5> kRanges{
        {{1, kMostSteps}, {0, 1}, {0, 1}, {-127, 127}, {-32767, 32767}}};
    if (!reader.array(run, path)) {
        return;
    }
    if (run.size() != kRanges.size()) {
        reader.fail(path, "must be [steps, launch, has_target, axis, target]");
        return;
    }
    std::array<int, 5> numbers{};
    for (std::size_t i = 0; i < kRanges.size(); ++i) {
        const std::string place = path + pathPart(i);
        numbers[i] = static_cast<int>(reader.number(run[i], place, kRanges[i][0], kRanges[i][1]));
    }
    if (static_cast<double>(inputs.size()) + numbers[0] > kMostSteps) {
        reader.fail(path, "is more than six hours of play");
        return;
    }
    const PlayInput input{numbers[1] != 0, numbers[2] != 0, static_cast<std::int8_t>(numbers[3]),
                          static_cast<std::int16_t>(numbers[4])};
    if (!reader.failed()) {
        inputs.insert(inputs.end(), static_cast<std::size_t>(numbers[0]), input);
    }
}

} // namespace

std::string hexOf(std::uint64_t value) {
    std::string text(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4) {
        text[i] = kHexDigits[value & 15];
    }
    return text;
}

std::string Play::toJson() const {
    std::string text =
        "{\"squashout_play\":1,\"seed\":\"" + hexOf(seed) + "\",\"gravity\":" + (gravity ? "true" : "false") +
        ",\"first_level\":" + std::to_string(first_level) + ",\"hash\":\"" + hexOf(hash) + "\",\n\"inputs\":[";
    for (std::size_t i = 0; i < inputs.size();) {
        std::size_t end = i;
        while (end < inputs.size() && inputs[end] == inputs[i]) {
            ++end;
        }
        const PlayInput& input = inputs[i];
        text += i == 0 ? "" : ",";
        text += text.size() - text.rfind('\n') > 110 ? "\n" : "";
        text += '[' + std::to_string(end - i);
        for (const int number : {int{input.launch}, int{input.has_target}, int{input.axis}, int{input.target}}) {
            text += ',' + std::to_string(number);
        }
        text += ']';
        i = end;
    }
    return text + "]}\n";
}

Result<Play> Play::fromJson(std::string_view text, const std::string& file) {
    auto parsed = elastoon::parseJson(text, file);
    if (!parsed) {
        return parsed.error();
    }
    const Json& json = parsed.value();
    JsonReader reader(file);
    Play play;
    if (!reader.object(json, "", {"squashout_play", "seed", "gravity", "first_level", "hash", "inputs"})) {
        return *reader.error();
    }
    if (const Json* version = reader.required(json, "", "squashout_play")) {
        (void)reader.number(*version, "/squashout_play", 1, 1);
    }
    if (const Json* seed = reader.required(json, "", "seed")) {
        play.seed = fromHex(reader, *seed, "/seed");
    }
    if (const Json* gravity = reader.required(json, "", "gravity")) {
        play.gravity = reader.boolean(*gravity, "/gravity");
    }
    if (const Json* first = reader.required(json, "", "first_level")) {
        play.first_level = static_cast<std::uint32_t>(reader.number(*first, "/first_level", 0, 999));
    }
    if (const Json* hash = reader.required(json, "", "hash")) {
        play.hash = fromHex(reader, *hash, "/hash");
    }
    const Json* inputs = reader.required(json, "", "inputs");
    if (inputs != nullptr && reader.array(*inputs, "/inputs")) {
        for (std::size_t i = 0; i < inputs->size() && !reader.failed(); ++i) {
            readRun(reader, (*inputs)[i], "/inputs" + pathPart(i), play.inputs);
        }
    }
    if (reader.failed()) {
        return *reader.error();
    }
    return play;
}

Result<Game> replay(const Play& play, std::shared_ptr<const std::vector<Level>> levels) {
    Game game({std::move(levels), play.seed, play.gravity, play.first_level});
    for (const PlayInput& input : play.inputs) {
        game.step(input);
    }
    if (game.hash() != play.hash) {
        return Error{"went another way than when it was recorded: its hash is " + hexOf(game.hash()) + ", was " +
                         hexOf(play.hash),
                     "play"};
    }
    return game;
}

} // namespace squashout
