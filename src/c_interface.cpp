// The C interface's versions, errors, ids and conversions. See elastoon.h and c_interface.h.
#include "c_interface.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

namespace elastoon::c_interface {

namespace {

constexpr std::size_t kMostErrorText = 2048;
/// A fixed place, so that telling of an error needs no memory.
thread_local std::array<char, kMostErrorText> last_error{};

template <class T>
Table<T>& lastingTable() {
    static Table<T>* const kTable = new Table<T>();
    return *kTable;
}

void append(std::size_t& size, std::string_view text) {
    const std::size_t part = std::min(text.size(), kMostErrorText - 1 - size);
    std::memcpy(last_error.data() + size, text.data(), part);
    size += part;
    last_error[size] = '\0';
}

} // namespace

Table<HeldWorld>& worlds() {
    return lastingTable<HeldWorld>();
}

Table<ShapePtr>& shapes() {
    return lastingTable<ShapePtr>();
}

ElastoonResult refuse(ElastoonResult code, std::string_view message, std::string_view where) {
    std::size_t size = 0;
    if (!where.empty()) {
        append(size, where);
        append(size, ": ");
    }
    append(size, message);
    return code;
}

ElastoonResult refuse(ElastoonResult code, const Error& error) {
    return refuse(code, error.message, error.where);
}

ElastoonResult badId(std::string_view kind) {
    return refuse(kElastoonBadId, "the id names nothing: it is null, of something that was destroyed, or made up",
                  kind);
}

ElastoonResult nullPointer(std::string_view argument) {
    return refuse(kElastoonBadArgument, "must not be a null pointer", argument);
}

std::span<const BodyId> HeldWorld::knownBodies() {
    if (!bodies_known) {
        bodies = world.bodies();
        slots = world.matrices().size() / 12;
        bodies_known = true;
    }
    return bodies;
}

std::size_t HeldWorld::slotCount() {
    knownBodies();
    return slots;
}

HeldWorld* find(ElastoonWorld id) {
    return worlds().find({id.slot, id.generation});
}

const ShapePtr* find(ElastoonShape id) {
    return shapes().find({id.slot, id.generation});
}

HeldWorld* worldOf(ElastoonBody id) {
    HeldWorld* held = find(id.world);
    return held != nullptr && held->world.contains(from(id)) ? held : nullptr;
}

HeldWorld* worldOf(ElastoonObstacle id) {
    HeldWorld* held = find(id.world);
    return held != nullptr && held->world.contains(from(id)) ? held : nullptr;
}

ElastoonResult giveId(World world, ElastoonWorld* out_world) {
    auto made = std::make_unique<HeldWorld>(std::move(world));
    HeldWorld& held = *made;
    const auto key = worlds().add(std::move(made));
    if (key.slot == 0) {
        return refuse(kElastoonRefused, "there are too many worlds; destroy those that are not needed");
    }
    held.id = {key.slot, key.generation};
    *out_world = held.id;
    return kElastoonOk;
}

ElastoonResult giveId(ShapePtr shape, ElastoonShape* out_shape) {
    const auto key = shapes().add(std::make_unique<ShapePtr>(std::move(shape)));
    if (key.slot == 0) {
        return refuse(kElastoonRefused, "there are too many shapes; destroy those that are not needed");
    }
    *out_shape = {key.slot, key.generation};
    return kElastoonOk;
}

Style from(const ElastoonStyle& style) {
    Style result;
    result.restitution = style.restitution;
    result.max_stretch = style.max_stretch;
    result.min_squash = style.min_squash;
    result.stretch_rate = style.stretch_rate;
    result.squash_rate = style.squash_rate;
    result.reversal_rate = style.reversal_rate;
    result.rest_speed = style.rest_speed;
    result.rest_slope = style.rest_slope;
    result.friction = style.friction;
    result.grazing_angle = style.grazing_angle;
    result.squash_law = static_cast<SquashLaw>(style.squash_law);
    result.impact_easing = static_cast<ImpactEasing>(style.impact_easing);
    result.corner_rule = static_cast<CornerRule>(style.corner_rule);
    return result;
}

ElastoonStyle toC(const Style& style) {
    return {style.restitution,
            style.max_stretch,
            style.min_squash,
            style.stretch_rate,
            style.squash_rate,
            style.reversal_rate,
            style.rest_speed,
            style.rest_slope,
            style.friction,
            style.grazing_angle,
            static_cast<std::int32_t>(style.squash_law),
            static_cast<std::int32_t>(style.impact_easing),
            static_cast<std::int32_t>(style.corner_rule)};
}

ElastoonEvent toC(const Event& event, ElastoonWorld world) {
    return {event.time,
            toC(event.body, world),
            toC(event.other, world),
            toC(event.point),
            toC(event.normal),
            event.speed,
            event.s_in,
            event.s_mid,
            event.s_out,
            event.t_in,
            event.t_out,
            static_cast<std::int32_t>(event.type)};
}

ElastoonResult checkChoices(const ElastoonStyle& style) {
    const auto bad = [](std::int32_t choice) { return choice < 0 || choice > 1; };
    if (bad(style.squash_law)) {
        return refuse(kElastoonBadArgument, "must be kElastoonBounded or kElastoonPaper", "squash_law");
    }
    if (bad(style.impact_easing)) {
        return refuse(kElastoonBadArgument, "must be kElastoonSmooth or kElastoonLinear", "impact_easing");
    }
    if (bad(style.corner_rule)) {
        return refuse(kElastoonBadArgument, "must be kElastoonQueued or kElastoonBlended", "corner_rule");
    }
    return kElastoonOk;
}

ElastoonResult fromDef(const ElastoonBodyDef& def, BodyDef& out_def) {
    const ShapePtr* shape = find(def.shape);
    if (shape == nullptr) {
        return badId("shape");
    }
    if (const ElastoonResult flaw = checkChoices(def.style); flaw != kElastoonOk) {
        return flaw;
    }
    out_def = {*shape, from(def.style), from(def.position), from(def.velocity), from(def.rotation), def.user_data};
    return kElastoonOk;
}

} // namespace elastoon::c_interface

using namespace elastoon::c_interface;

ElastoonVersion elastoonVersion(void) {
    return {ELASTOON_VERSION_MAJOR, ELASTOON_VERSION_MINOR, ELASTOON_VERSION_PATCH};
}

const char* elastoonLastError(void) {
    return last_error.data();
}

const char* elastoonResultName(ElastoonResult result) {
    constexpr const char* kNames[] = {"ok",        "bad id",   "bad argument", "refused",
                                      "too small", "bad data", "out of memory"};
    const auto index = static_cast<std::size_t>(result);
    return index < std::size(kNames) ? kNames[index] : "unknown";
}
