// An independent witness of a game: every ball against every wall and block, by brute force over vertices and candidate
// axes in extended precision, and the rules' promises besides.
#pragma once

#include "game.h"
#include "oracle_solids.h"

#include <map>
#include <string>

namespace squashout {

/// What was seen of one or many games. Lengths in units of the ball's diameter.
struct Seen {
    double depth = 0.0; ///< deepest penetration into a wall
    double solid_depth = 0.0; ///< into a block or the paddle
    double slowest = 1e9, fastest = 0.0; ///< in flight, of the speed that its height asks for
    double longest_contact = 0.0; ///< s, one ball, without a moment of flight
    std::size_t looks = 0, not_finite = 0, escapes = 0;
    std::size_t squeezes = 0;
    std::string deepest_where;

    static constexpr double kMostDepth = 1e-5, kMostContact = 1.0;
    [[nodiscard]] bool holds() const {
        return not_finite == 0 && escapes == 0 && depth <= kMostDepth && solid_depth <= kMostDepth;
    }
    void add(const Seen& other);
};

class Witness {
public:
    /// To be called after each step.
    void look(const Game& game);
    [[nodiscard]] const Seen& seen() const { return seen_; }

private:
    void lookAt(const Game& game, const Ball& ball, const elastoon::Phase& phase, double t);
    [[nodiscard]] const elastoon::SolidWitness& solidOf(const elastoon::ShapePtr& shape);

    Seen seen_;
    std::map<std::uint64_t, elastoon::SolidWitness> solids_; ///< by content
    std::map<std::uint32_t, double> contact_since_;
};

} // namespace squashout
