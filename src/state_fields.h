// The layout of a world's records in bytes: one list of fields for writing and for reading. docs/snapshot.md.
#pragma once

#include "byte_stream.h"
#include "elastoon/phase.h"
#include "elastoon/world.h"
#include "flight.h"
#include "path.h"
#include "step.h"

#include <functional>

namespace elastoon {

/// The shapes of one snapshot, in the order in which they are met.
class ShapeTable {
public:
    void clear();
    /// Place in the table, from 1; 0 for none.
    std::uint32_t placeOf(const ShapePtr& shape);
    [[nodiscard]] const std::vector<ShapePtr>& shapes() const { return shapes_; }

private:
    void grow();
    [[nodiscard]] std::size_t bucketOf(const Shape* shape) const;

    std::vector<ShapePtr> shapes_;
    std::vector<std::uint32_t> buckets_; ///< places by content; 0: free. Their number is a power of two.
    std::uint32_t last_ = 0;
};

class StateWriter : public ByteWriter {
public:
    StateWriter(std::vector<std::byte>& out, ShapeTable& shapes) : ByteWriter(out), shapes_(shapes) {}
    void shape(const ShapePtr& shape) { (*this)(shapes_.placeOf(shape)); }

private:
    ShapeTable& shapes_;
};

class StateReader : public ByteReader {
public:
    StateReader(std::span<const std::byte> bytes, std::span<const ShapePtr> shapes)
        : ByteReader(bytes), shapes_(shapes) {}
    void shape(ShapePtr& shape) {
        std::uint32_t place = 0;
        (*this)(place);
        if (place > shapes_.size()) {
            spoil();
        } else if (place == 0) {
            shape = nullptr;
        } else if (shape != shapes_[place - 1]) {
            shape = shapes_[place - 1];
        }
    }

private:
    std::span<const ShapePtr> shapes_;
};

/// T or const T.
template <class T, class U>
concept Of = std::same_as<std::remove_const_t<T>, U>;

template <class Stream>
void fields(Stream& stream, Of<Style> auto& style) {
    stream(style.restitution, style.max_stretch, style.min_squash, style.stretch_rate, style.squash_rate,
           style.squash_law, style.impact_easing, style.reversal_rate, style.rest_speed, style.rest_slope,
           style.friction, style.grazing_angle, style.corner_rule);
}

template <class Stream>
void fields(Stream& stream, const SharedStyle& style) {
    fields(stream, static_cast<const Style&>(style));
}

template <class Stream>
void fields(Stream& stream, SharedStyle& style) {
    Style read;
    fields(stream, read);
    if (!(read == static_cast<const Style&>(style))) {
        style = read;
    }
}

template <class Stream>
void fields(Stream& stream, Of<MovingFrame> auto& frame) {
    stream(frame.start, frame.origin, frame.orientation, frame.velocity, frame.angular_velocity);
}

template <class Stream>
void fields(Stream& stream, Of<Surface> auto& surface) {
    fields(stream, surface.frame);
    stream(surface.point, surface.normal);
    stream.shape(surface.solid);
}

template <class Stream>
void fields(Stream& stream, Of<Ease> auto& ease) {
    stream(ease.span, ease.axis, ease.angle, ease.stretch);
}

template <class Stream>
void fields(Stream& stream, const Boxed<Ease>& ease) {
    fields(stream, *ease);
}

template <class Stream>
void fields(Stream& stream, Boxed<Ease>& ease) {
    Ease read;
    fields(stream, read);
    ease = read == Ease{} ? Boxed<Ease>{} : Boxed<Ease>(read);
}

template <class Stream>
void fields(Stream& stream, Of<Flight> auto& flight) {
    stream(flight.position, flight.velocity, flight.gravity, flight.orientation, flight.reversal_speed,
           flight.max_stretch, flight.stretch_rate);
    fields(stream, flight.ease);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(flight)>>) {
        completeFlight(flight);
    }
}

template <class Stream>
void fields(Stream& stream, Of<Impact> auto& impact) {
    fields(stream, impact.surface);
    auto& curve = impact.curve;
    stream(impact.begun, impact.contact_in_shape, impact.orientation, impact.turn_axis, impact.turn_angle,
           impact.turn_from, impact.skims, curve.s_in, curve.s_mid, curve.s_out, curve.omega_in, curve.omega_out,
           curve.t_in, curve.t_out, impact.easing, impact.velocity_in, impact.velocity_out, impact.comes_to_rest);
}

template <class Stream>
void fields(Stream& stream, Of<Rest> auto& rest) {
    fields(stream, rest.surface);
    stream(rest.pose.position, rest.pose.orientation, rest.pose.stretch);
}

template <class Stream>
void fields(Stream& stream, Of<Slide> auto& slide) {
    fields(stream, slide.surface);
    stream(slide.begun, slide.foot, slide.direction, slide.velocity, slide.acceleration, slide.orientation,
           slide.max_stretch, slide.stretch_rate);
    fields(stream, slide.ease);
}

template <class Stream, class T>
void fields(Stream& stream, const Boxed<T>& boxed) {
    fields(stream, *boxed);
}

template <class Stream, class T>
void fields(Stream& stream, Boxed<T>& boxed) {
    fields(stream, boxed.edit());
}

template <class Stream>
void fields(Stream& stream, Of<KeptClear> auto& kept) {
    fields(stream, kept.surface);
    stream(kept.obstacle, kept.since, kept.until, kept.presses);
}
inline constexpr std::size_t kKeptClearBytes = 189;

template <class Stream>
void fields(Stream& stream, Of<Phase> auto& phase) {
    stream(phase.start, phase.end, phase.obstacle, phase.free_from);
    stream.sized(phase.clear_of, kKeptClearBytes);
    for (auto& kept : phase.clear_of) {
        fields(stream, kept);
    }
    stream.choice(phase.motion);
    std::visit([&](auto& motion) { fields(stream, motion); }, phase.motion);
}
/// Of a slot's or a record's least: what counts are held against.
inline constexpr std::size_t kPhaseBytes = 37;

template <class Stream>
void fields(Stream& stream, Of<Event> auto& event) {
    stream(event.time, event.type, event.body, event.other, event.point, event.normal, event.speed, event.s_in,
           event.s_mid, event.s_out, event.t_in, event.t_out);
}
inline constexpr std::size_t kEventBytes = 121;

template <class Stream>
void fields(Stream& stream, Of<PhaseBegun> auto& begun) {
    stream(begun.body);
    fields(stream, begun.phase);
}

template <class Stream>
void fields(Stream& stream, Of<PathKey> auto& key) {
    stream(key.time, key.position, key.rotation);
}
inline constexpr std::size_t kPathKeyBytes = 64;

template <class Stream>
void pathKeyFields(Stream& stream, auto& keys) {
    stream.sized(keys, kPathKeyBytes);
    for (auto& key : keys) {
        fields(stream, key);
    }
}

template <class Stream>
void fields(Stream& stream, Of<Path> auto& path) {
    stream(path.added, path.position, path.rotation, path.repeats);
    pathKeyFields(stream, path.keys);
}

template <class Stream>
void fields(Stream& stream, Of<ObstacleSlot> auto& slot) {
    stream(slot.generation, slot.used);
    if (slot.used) {
        stream.shape(slot.shape);
        stream(slot.normal, slot.user_data);
        fields(stream, slot.frame);
        fields(stream, slot.path);
    }
}
/// Of a slot that is free.
inline constexpr std::size_t kSlotBytes = 5;

template <class Stream>
void fields(Stream& stream, Of<BodySlot> auto& slot) {
    stream(slot.generation, slot.used);
    if (slot.used) {
        stream.shape(slot.shape);
        stream(slot.user_data);
        fields(stream, slot.style);
        fields(stream, slot.phase);
    }
}

/// The shapes' table: for each its hash and counts, and, if they are embedded, its parts.
void writeShapes(StateWriter& writer, const ShapeTable& table, bool embedded);
/// Finds a shape by its contentHash(); null where it is not known.
using FindShape = std::function<ShapePtr(std::uint64_t)>;
/// The table's shapes. Embedded ones that are known already are not made again.
[[nodiscard]] Result<std::vector<ShapePtr>> readShapes(ByteReader& reader, bool embedded, const FindShape& find,
                                                       const char* what);

} // namespace elastoon
