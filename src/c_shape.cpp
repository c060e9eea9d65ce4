// The C interface to shapes. See elastoon.h.
#include "c_interface.h"

#include <vector>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

/// make() is asked only when there is a place for what it makes.
template <class Make>
ElastoonResult create(ElastoonShape* out_shape, Make&& make) {
    return guarded([&] {
        if (out_shape == nullptr) {
            return nullPointer("out_shape");
        }
        Result<ShapePtr> made = make();
        return made ? giveId(std::move(made).value(), out_shape) : refuse(kElastoonBadArgument, made.error());
    });
}

} // namespace

ElastoonResult elastoonShapeSphere(double radius, int32_t cuts, ElastoonShape* out_shape) {
    return create(out_shape, [&] { return Shape::sphere(radius, cuts); });
}

ElastoonResult elastoonShapeBox(double x, double y, double z, ElastoonShape* out_shape) {
    return create(out_shape, [&] { return Shape::box({x, y, z}); });
}

ElastoonResult elastoonShapeCylinder(double radius, double length, int32_t sides, ElastoonShape* out_shape) {
    return create(out_shape, [&] { return Shape::cylinder(radius, length, sides); });
}

ElastoonResult elastoonShapeCone(double radius, double length, int32_t sides, ElastoonShape* out_shape) {
    return create(out_shape, [&] { return Shape::cone(radius, length, sides); });
}

ElastoonResult elastoonShapeCapsule(double radius, double length, int32_t sides, ElastoonShape* out_shape) {
    return create(out_shape, [&] { return Shape::capsule(radius, length, sides); });
}

ElastoonResult elastoonShapeHull(const ElastoonVec3* points, size_t count, ElastoonShape* out_shape) {
    if (points == nullptr && count > 0) {
        return nullPointer("points");
    }
    return create(out_shape, [&] {
        std::vector<Vec3> given;
        given.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            given.push_back(from(points[i]));
        }
        return Shape::hull(given);
    });
}

ElastoonResult elastoonShapeDestroy(ElastoonShape shape) {
    return shapes().remove({shape.slot, shape.generation}) != nullptr ? kElastoonOk : badId("shape");
}

bool elastoonShapeIsValid(ElastoonShape shape) {
    return find(shape) != nullptr;
}

ElastoonResult elastoonShapeInfo(ElastoonShape shape, ElastoonShapeInfo* out_info) {
    const ShapePtr* found = find(shape);
    if (found == nullptr) {
        return badId("shape");
    }
    if (out_info == nullptr) {
        return nullPointer("out_info");
    }
    const Shape& made = **found;
    *out_info = {static_cast<std::int32_t>(made.kind()),
                 made.length(),
                 made.volume(),
                 made.radius(),
                 made.boundingRadius(),
                 toC(made.extents()),
                 toC(made.centroidOfInput()),
                 made.contentHash()};
    return kElastoonOk;
}

ElastoonResult elastoonShapeVertices(ElastoonShape shape, ElastoonVec3* out_vertices, size_t capacity,
                                     size_t* out_count) {
    const ShapePtr* found = find(shape);
    if (found == nullptr) {
        return badId("shape");
    }
    const auto vertices = (*found)->vertices();
    return writeList(vertices.size(), out_vertices, capacity, out_count,
                     [&](std::size_t i) { return toC(vertices[i]); });
}

ElastoonResult elastoonShapeTriangles(ElastoonShape shape, uint32_t* out_indices, size_t capacity, size_t* out_count) {
    return guarded([&] {
        const ShapePtr* found = find(shape);
        if (found == nullptr) {
            return badId("shape");
        }
        // Faces are convex: a fan about the first vertex.
        std::vector<std::uint32_t> indices;
        for (std::size_t f = 0; f < (*found)->faceCount(); ++f) {
            const auto face = (*found)->face(f);
            for (std::size_t i = 2; i < face.size(); ++i) {
                indices.insert(indices.end(), {face[0], face[i - 1], face[i]});
            }
        }
        return writeList(indices.size(), out_indices, capacity, out_count, [&](std::size_t i) { return indices[i]; });
    });
}
