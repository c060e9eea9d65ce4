// Who measures distances: ours and the peers, all from the same poses.
#pragma once

#include "poses.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elastoon {

class DistanceContender {
public:
    explicit DistanceContender(std::string name, bool bakes) : name_(std::move(name)), bakes_(bakes) {}
    DistanceContender(const DistanceContender&) = delete;
    DistanceContender& operator=(const DistanceContender&) = delete;
    virtual ~DistanceContender() = default;

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Whether it has to deform the vertices before it can ask.
    [[nodiscard]] bool bakes() const { return bakes_; }
    /// Deforms for every pose and asks nothing.
    virtual void bakeAll(std::span<const Pose> poses) = 0;
    /// Bakes and asks for every pose; NaN where there is no answer.
    virtual void run(std::span<const Pose> poses, std::span<double> distances) = 0;

private:
    std::string name_;
    bool bakes_;
};

/// Does what is the same for all contenders; T has bake(pose) and ask(pose).
template <class T>
class DistanceLoop : public DistanceContender {
public:
    void bakeAll(std::span<const Pose> poses) override {
        for (const Pose& pose : poses) {
            static_cast<T*>(this)->bake(pose);
        }
    }
    void run(std::span<const Pose> poses, std::span<double> distances) override {
        for (std::size_t i = 0; i < poses.size(); ++i) {
            static_cast<T*>(this)->bake(poses[i]);
            distances[i] = static_cast<T*>(this)->ask(poses[i]);
        }
    }

private:
    friend T;
    DistanceLoop(std::string name, bool bakes) : DistanceContender(std::move(name), bakes) {}
};

using DistanceContenders = std::vector<std::unique_ptr<DistanceContender>>;

/// V-Clip first, which the others are compared with; then GJK.
void addOurs(const DistanceScene& scene, DistanceContenders& all);
void addFcl(const DistanceScene& scene, DistanceContenders& all);
void addBullet(const DistanceScene& scene, DistanceContenders& all);
void addCcd(const DistanceScene& scene, DistanceContenders& all);

} // namespace elastoon
