// A performed scene made ready to be drawn: its things at any time, the setting about them, the camera, the tracer.
#pragma once

#include "camera.h"
#include "tracer.h"

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <vector>

namespace elastoon {

/// What the camera has to see: from when to when, and how ghosts are laid out.
struct ShowSpan {
    double from = 0.0, to = 0.0; ///< s
    Vec3 spread{0.0};            ///< m/s: a thing of time t is drawn t * spread aside
};

/// The scene and the timeline must outlive it; the timeline's tracks are the scene's bodies in order.
class Show {
public:
    static Result<Show> create(const Scene& scene, const Timeline& timeline, const ShowSpan& span, PictureSize size,
                               const TraceOptions& options);

    /// The bodies at time t.
    [[nodiscard]] std::vector<Thing> bodiesAt(double t) const;
    /// Whether anything, bodies or obstacles, is elsewhere at b than at a. Spread does not count.
    [[nodiscard]] bool changes(double a, double b) const;
    /// Puts obstacles where they are at time t. Cheap where they do not move.
    void setTime(double t);
    [[nodiscard]] const Tracer& tracer() const { return tracer_; }
    [[nodiscard]] const Camera& camera() const { return camera_; }

private:
    Show(const Scene& scene, const Timeline& timeline, const ShowSpan& span, Tracer tracer)
        : scene_(&scene), timeline_(&timeline), span_(span), tracer_(std::move(tracer)) {}
    void addMeshes();
    [[nodiscard]] bool obstaclesMove() const;
    void placeAt(double t);

    const Scene* scene_;
    const Timeline* timeline_;
    ShowSpan span_;
    Tracer tracer_;
    Camera camera_;
    Setting setting_; ///< without planes: those of a time are added
    std::vector<std::size_t> body_meshes_, obstacle_meshes_;
    double placed_at_ = 0.0;
};

/// Points that hold all that bodies do in the span, and the ground under them: what a camera has to frame.
[[nodiscard]] std::vector<Vec3> actionPoints(const Scene& scene, const Timeline& timeline, const ShowSpan& span);

} // namespace elastoon
