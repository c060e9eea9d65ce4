// See state_fields.h.
#include "state_fields.h"

#include "shape_parts.h"

#include <algorithm>
#include <string>

namespace elastoon {

void ShapeTable::clear() {
    shapes_.clear();
    std::fill(buckets_.begin(), buckets_.end(), 0);
    last_ = 0;
}

std::size_t ShapeTable::bucketOf(const Shape* shape) const {
    std::size_t bucket = shape->contentHash() & (buckets_.size() - 1);
    while (buckets_[bucket] != 0 && shapes_[buckets_[bucket] - 1].get() != shape) {
        bucket = (bucket + 1) & (buckets_.size() - 1);
    }
    return bucket;
}

void ShapeTable::grow() {
    buckets_.assign(std::max<std::size_t>(64, 2 * buckets_.size()), 0);
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
        buckets_[bucketOf(shapes_[i].get())] = i + 1;
    }
}

std::uint32_t ShapeTable::placeOf(const ShapePtr& shape) {
    if (!shape) {
        return 0;
    }
    if (last_ != 0 && shapes_[last_ - 1] == shape) {
        return last_;
    }
    if (2 * (shapes_.size() + 1) > buckets_.size()) {
        grow();
    }
    std::uint32_t& place = buckets_[bucketOf(shape.get())];
    if (place == 0) {
        shapes_.push_back(shape);
        place = static_cast<std::uint32_t>(shapes_.size());
    }
    last_ = place;
    return place;
}

void writeShapes(StateWriter& writer, const ShapeTable& table, bool embedded) {
    writer(static_cast<std::uint32_t>(table.shapes().size()));
    for (const ShapePtr& shape : table.shapes()) {
        writer(shape->contentHash(), static_cast<std::uint32_t>(shape->vertices().size()),
               static_cast<std::uint32_t>(shape->faceCount()));
        if (embedded) {
            const ShapeParts parts = ShapeParts::of(*shape);
            shapeFields(writer, parts);
        }
    }
}

namespace {

Result<ShapePtr> shapeFrom(ShapeParts&& parts, std::uint64_t hash) {
    if (auto flaw = parts.flaw()) {
        return *flaw;
    }
    ShapePtr shape = ShapeParts::toShape(std::move(parts));
    if (shape->contentHash() != hash) {
        return Error{"it is not the one that its hash names", "shape"};
    }
    return shape;
}

} // namespace

Result<std::vector<ShapePtr>> readShapes(ByteReader& reader, bool embedded, const FindShape& find, const char* what) {
    constexpr std::size_t kShapeBytes = 16;
    std::vector<ShapePtr> shapes;
    reader.sized(shapes, kShapeBytes);
    for (std::size_t i = 0; i < shapes.size() && reader.good(); ++i) {
        std::uint64_t hash = 0;
        std::uint32_t vertex_count = 0;
        std::uint32_t face_count = 0;
        reader(hash, vertex_count, face_count);
        ShapeParts parts;
        parts.polytope.face_begin.clear();
        if (embedded) {
            shapeFields(reader, parts);
        }
        shapes[i] = reader.good() ? find(hash) : nullptr;
        if (!shapes[i] && embedded && reader.good()) {
            auto made = shapeFrom(std::move(parts), hash);
            if (!made) {
                return Error{"shape " + std::to_string(i) + " is unsound: " + made.error().message, what};
            }
            shapes[i] = made.value();
        }
        if (!reader.good()) {
            break;
        }
        if (!shapes[i]) {
            return Error{"shape " + std::to_string(i) + " (" + std::to_string(vertex_count) + " vertices, " +
                             std::to_string(face_count) +
                             " faces) is not known here: give it among the known shapes, or save with include_shapes",
                         what};
        }
        if (shapes[i]->vertices().size() != vertex_count || shapes[i]->faceCount() != face_count) {
            return Error{"shape " + std::to_string(i) + " has other counts than the shape of that hash", what};
        }
    }
    if (!reader.good()) {
        return Error{"the list of shapes is damaged: it ends too soon, or counts more than there is", what};
    }
    return shapes;
}

} // namespace elastoon
