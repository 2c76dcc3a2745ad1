// Triangle test: Woop, Benthin and Wald, Watertight ray/triangle intersection, JCGT 2013, in double. Corners are
// floats, so the edge functions of a shared edge are each other's exact negatives and no ray passes between two
// triangles.
//
// Why the answer does not depend on Embree's instruction set or tree: the ray is the float one that Embree sees; boxes
// are padded by far more than Embree's rounding, so every triangle that our test could accept at t <= the best so far
// is proposed; and the ray's far end handed back to Embree is rounded up by more than that rounding too.
#include "lighting/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/sanitizers.h"
#include "scenes/scene_limits.h"

namespace twinshade {
namespace {

struct Triangle {
  glm::vec3 corner[3];
  std::uint32_t index;  // in the scene
  float side;           // +1: counter-clockwise is the front, -1: its vertex normals say otherwise
};

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// One ray on its way through Embree: the ray in the sheared frame of the test, and the best hit so far.
struct Query {
  RTCIntersectContext context;  // first: Embree hands back a pointer to it
  int kx, ky, kz;
  double ox, oy, oz;
  double sx, sy, sz;
  double best_t;
  double best_u, best_v, best_w;
  const Triangle* best;
  std::uint32_t skip;

  Query(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t skipped) : skip(skipped) {
    rtcInitIntersectContext(&context);
    const float ax = std::abs(direction.x), ay = std::abs(direction.y), az = std::abs(direction.z);
    kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    kx = kz == 2 ? 0 : kz + 1;
    ky = kx == 2 ? 0 : kx + 1;
    if (direction[kz] < 0) std::swap(kx, ky);
    ox = origin[kx], oy = origin[ky], oz = origin[kz];
    sz = 1.0 / double(direction[kz]);
    sx = double(direction[kx]) * sz;
    sy = double(direction[ky]) * sz;
    best_t = std::numeric_limits<double>::infinity();
    best = nullptr;
  }

  // Takes the triangle if it is hit closer than the best so far. True if it was taken.
  bool test(const Triangle& triangle) {
    if (triangle.index == skip) return false;
    const glm::vec3 &a = triangle.corner[0], &b = triangle.corner[1], &c = triangle.corner[2];
    const double az = double(a[kz]) - oz, bz = double(b[kz]) - oz, cz = double(c[kz]) - oz;
    const double ax = (double(a[kx]) - ox) - sx * az, ay = (double(a[ky]) - oy) - sy * az;
    const double bx = (double(b[kx]) - ox) - sx * bz, by = (double(b[ky]) - oy) - sy * bz;
    const double cx = (double(c[kx]) - ox) - sx * cz, cy = (double(c[ky]) - oy) - sy * cz;
    const double u = cx * by - cy * bx;
    const double v = ax * cy - ay * cx;
    const double w = bx * ay - by * ax;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    const double det = (u + v) + w;
    if (det == 0) return false;
    const double t = ((u * az + v * bz) + w * cz) * sz / det;
    if (!(t > 0) || t > best_t || (t == best_t && best && best->index < triangle.index)) return false;
    best_t = t;
    best_u = u / det, best_v = v / det, best_w = w / det;
    best = &triangle;
    return true;
  }
};

// A float that is certainly not below t, by more than the rounding of any box test.
float far_end(double t) { return float(t * (1.0 + 0x1p-20)); }

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = 0;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

}  // namespace

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_of_scene;  // scene index -> index into triangles, or kNoTriangle
  float padding = 0;
  double lift = 0;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const Impl& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
    const Triangle& triangle = self.triangles[arguments->primID];
    const glm::vec3 low = glm::min(glm::min(triangle.corner[0], triangle.corner[1]), triangle.corner[2]);
    const glm::vec3 high = glm::max(glm::max(triangle.corner[0], triangle.corner[1]), triangle.corner[2]);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = low.x - self.padding, out.lower_y = low.y - self.padding, out.lower_z = low.z - self.padding;
    out.upper_x = high.x + self.padding, out.upper_y = high.y + self.padding, out.upper_z = high.z + self.padding;
  }
};

namespace {

constexpr double kRayLift = 0x1p-16;       // of the diagonal
constexpr double kRoundingLift = 0x1p-22;  // of a coordinate
// A diagonal this many times that of the scene's core is made by what lies far from it: a sky dome, a far hill.
constexpr double kLargestSpread = 64;

// Of the box between the lower quartile of triangles' lower ends and the upper quartile of their upper ends.
double core_diagonal(const std::vector<Triangle>& triangles) {
  const std::size_t quarter = triangles.size() / 4;
  std::vector<float> low(triangles.size()), high(triangles.size());
  glm::dvec3 size(0);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const glm::vec3* corner = triangles[t].corner;
      low[t] = std::min({corner[0][axis], corner[1][axis], corner[2][axis]});
      high[t] = std::max({corner[0][axis], corner[1][axis], corner[2][axis]});
    }
    std::nth_element(low.begin(), low.begin() + std::ptrdiff_t(quarter), low.end());
    std::nth_element(high.begin(), high.end() - 1 - std::ptrdiff_t(quarter), high.end());
    size[axis] = std::max(0.0, double(high[high.size() - 1 - quarter]) - double(low[quarter]));
  }
  return glm::length(size);
}

const Triangle& triangle_of(void* geometry, unsigned primitive) {
  return static_cast<const RayScene::Impl*>(geometry)->triangles[primitive];
}

void intersect_triangle(const RTCIntersectFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(arguments->context);
  if (query.test(triangle_of(arguments->geometryUserPtr, arguments->primID)))
    reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar = far_end(query.best_t);
}

void occlude_triangle(const RTCOccludedFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  Query& query = *reinterpret_cast<Query*>(arguments->context);
  if (query.test(triangle_of(arguments->geometryUserPtr, arguments->primID)))
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
}

// No thread count in the configuration: Embree would impose it on every user of TBB in the process. Under the thread
// sanitizer nothing else uses TBB, and Embree builds on our thread alone: the sanitizer does not see how Embree's and
// TBB's own threads, which are not compiled for it, wait for each other.
RTCDevice new_device() {
  std::string config = kThreadSanitizer ? "threads=1," : "", wanted;
  if (const char* isa = std::getenv("TWINSHADE_EMBREE_ISA")) wanted = isa;
  if (!wanted.empty()) {
    constexpr std::string_view known[] = {"sse2", "sse4.2", "avx", "avx2", "avx512"};
    if (std::find(std::begin(known), std::end(known), wanted) == std::end(known))
      throw UserError("TWINSHADE_EMBREE_ISA=" + wanted + " is none of sse2, sse4.2, avx, avx2, avx512");
    config += "isa=" + wanted;
  }
  const RTCDevice device = rtcNewDevice(config.c_str());
  if (!device)
    throw UserError(
        "Embree does not start" +
        (wanted.empty() ? std::string() : " with TWINSHADE_EMBREE_ISA=" + wanted + ": this processor lacks it"));
  return device;
}

}  // namespace

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  Impl& self = *impl_;

  // The triangles that can be hit, with their front side
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  self.triangle_of_scene.assign(scene.triangle_count(), kNoTriangle);
  for (std::size_t t = 0; t < scene.triangle_count(); ++t) {
    Triangle triangle{};
    triangle.index = std::uint32_t(t);
    glm::dvec3 normals(0);
    bool usable = true;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = scene.indices[3 * t + k];
      triangle.corner[k] = scene.positions[vertex];
      normals += glm::dvec3(scene.normals[vertex]);
      usable = usable && finite(triangle.corner[k]);
    }
    if (!usable) continue;
    const glm::dvec3 a(triangle.corner[0]), b(triangle.corner[1]), c(triangle.corner[2]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    if (!(glm::dot(cross, cross) > 0)) continue;
    triangle.side = glm::dot(cross, normals) < 0 ? -1.0f : 1.0f;
    low = glm::min(low, glm::min(glm::min(a, b), c));
    high = glm::max(high, glm::max(glm::max(a, b), c));
    self.triangle_of_scene[t] = std::uint32_t(self.triangles.size());
    self.triangles.push_back(triangle);
  }
  if (self.triangles.empty()) return;
  const glm::dvec3 corner = glm::max(glm::abs(low), glm::abs(high));
  const double reach = std::max({corner.x, corner.y, corner.z}), diagonal = glm::length(high - low);
  if (reach > kLargestCoordinate)
    throw UserError((scene.name.empty() ? "the scene" : scene.name) +
                    ": its triangles reach farther than 1e15 from the origin; scale it down");
  self.padding = float(std::max(reach, diagonal) * 0x1p-18);
  self.lift = std::min(diagonal, kLargestSpread * core_diagonal(self.triangles)) * kRayLift;

  // Embree's tree over them
  self.device = new_device();
  self.scene = rtcNewScene(self.device);
  rtcSetSceneFlags(self.scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, unsigned(self.triangles.size()));
  rtcSetGeometryBoundsFunction(geometry, &Impl::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &intersect_triangle);
  rtcSetGeometryOccludedFunction(geometry, &occlude_triangle);
  rtcSetGeometryUserData(geometry, &self);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(self.scene, geometry);
  rtcCommitScene(self.scene);
  rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(self.device) != RTC_ERROR_NONE)
    throw UserError("Embree cannot build its tree over " + std::to_string(self.triangles.size()) +
                    " triangles: not enough memory?");
}

RayScene::~RayScene() = default;

RayHit RayScene::closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t skip) const {
  if (!impl_->scene) return {};
  Query query(origin, direction, skip);
  RTCRayHit ray{};
  ray.ray = make_ray(origin, direction);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &query.context, &ray);
  if (!query.best) return {};
  const Triangle& best = *query.best;
  const glm::dvec3 a(best.corner[0]), b(best.corner[1]), c(best.corner[2]);
  const double facing = glm::dot(glm::cross(b - a, c - a), glm::dvec3(direction)) * double(best.side);
  return {best.index, query.best_t, query.best_v, query.best_w, facing < 0};
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t skip) const {
  if (!impl_->scene) return false;
  Query query(origin, direction, skip);
  RTCRay ray = make_ray(origin, direction);
  rtcOccluded1(impl_->scene, &query.context, &ray);
  return query.best != nullptr;
}

glm::dvec3 RayScene::geometric_normal(std::uint32_t index) const {
  const std::uint32_t slot = impl_->triangle_of_scene[index];
  if (slot == kNoTriangle) return glm::dvec3(0);
  const Triangle& triangle = impl_->triangles[slot];
  const glm::dvec3 a(triangle.corner[0]), b(triangle.corner[1]), c(triangle.corner[2]);
  const glm::dvec3 cross = glm::cross(b - a, c - a) * double(triangle.side);
  return cross / std::sqrt(glm::dot(cross, cross));
}

double RayScene::lift(const glm::vec3& place) const {
  const glm::dvec3 p = glm::abs(glm::dvec3(place));
  return std::max(impl_->lift, std::max({p.x, p.y, p.z}) * kRoundingLift);
}

}  // namespace twinshade
