// Sculpture for the courtyard: smooth closed shapes with folds.
#pragma once

#include "scenes/surfaces.h"

namespace twinshade {

inline constexpr double kPedestalHeight = 0.95;  // metres

// A square pedestal with base and cap standing at `foot`.
void add_pedestal(PatchMesh& mesh, const glm::dvec3& foot, const Finish& moulding, const Finish& block);

// A draped standing figure, 1.75 m; `number` varies its turn and its folds.
void add_figure(PatchMesh& mesh, const glm::dvec3& foot, int number, const Finish& finish);

// A column of three strands twisted around each other, tapering to a point.
void add_twist(PatchMesh& mesh, const glm::dvec3& foot, double height, double radius, const Finish& finish);

}  // namespace twinshade
