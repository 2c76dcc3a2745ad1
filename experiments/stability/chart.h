// Charts of what stability finds.
#pragma once

#include "experiments/experiment.h"

namespace twinshade {

// One chart a kind of measure, over the methods that have it; none where no row has it.
std::vector<Picture> stability_charts(const Rows& rows);

}  // namespace twinshade
