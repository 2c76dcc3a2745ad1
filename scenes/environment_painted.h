// Environments that the program paints itself.
#pragma once

#include "scenes/environment.h"

namespace twinshade {

Environment paint_sky();       // clear sky over brown ground, a sun of 1 degree radius
Environment paint_studio();    // three soft boxes in a dark room
Environment paint_window();    // a room lit by one window of four panes
Environment paint_constant();  // radiance 1 from everywhere

}  // namespace twinshade
