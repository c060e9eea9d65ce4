// Bodies thrown at a box floor within one step of 1/60 s, and who finds when they touch it.
#pragma once

#include "elastoon/phase.h"
#include "poses.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elastoon {

inline constexpr double kCastStep = 1.0 / 60.0;

struct Cast {
    Phase phase;   ///< flight from time 0
    Pose from, to; ///< of the rigid cast: the pose at 0, moved to where the centroid is after the step
};

enum class CastMotion {
    Flight, ///< under gravity as it is: turns and stretches a little
    Lively, ///< under thirty times as much: turns and stretches much within the step
    Rigid,  ///< straight on, without gravity
};

/// Casts that hit, or that pass just above.
struct CastScene {
    BenchBody body;
    std::vector<Cast> casts;
};
[[nodiscard]] CastScene castScene(const BenchBody& body, CastMotion motion, bool hits, int count);

class CastContender {
public:
    CastContender(std::string name, CastMotion motion, bool bakes)
        : name_(std::move(name)), motion_(motion), bakes_(bakes) {}
    CastContender(const CastContender&) = delete;
    CastContender& operator=(const CastContender&) = delete;
    virtual ~CastContender() = default;
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] CastMotion motion() const { return motion_; }
    [[nodiscard]] bool bakes() const { return bakes_; }
    virtual void bakeAll(std::span<const Cast> casts) = 0;
    /// Times of touch, s; infinite where there is none.
    virtual void run(std::span<const Cast> casts, std::span<double> times) = 0;

private:
    std::string name_;
    CastMotion motion_;
    bool bakes_;
};

using CastContenders = std::vector<std::unique_ptr<CastContender>>;
void addOurCasts(const BenchBody& body, CastContenders& all);
void addBulletCasts(const BenchBody& body, CastContenders& all);

} // namespace elastoon
