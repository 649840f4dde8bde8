// Convergent light volumes: real-time indirect diffuse light, after Bratten and Linden (2013).
// The umbrella header for C++: the version and the whole library. Read conventions.h next. A shader includes the stage that it
// runs.
//
// The way of the light through the stages:
//   rsm       light, scene       -> ClvRsmTexel[]   lit surface samples
//   rays      ClvRsmTexel        -> ClvRay          into the texel's hemisphere
//   trace     ClvRay             -> ClvRay, ClvHit  cut at the first surface; the caller's own tracer
//   inject    ClvRay             -> deposits        into the cells that it crosses
//   merge     deposits, history  -> history
//   evaluate  position, normal   -> irradiance
// plan/ decides what a scene needs, cpu/ runs the stages as loops.
#ifndef CLV_CLV_H
#define CLV_CLV_H

#define CLV_VERSION_MAJOR 0
#define CLV_VERSION_MINOR 1
#define CLV_VERSION_PATCH 0

#include "conventions.h"
#include "lang.h"
#include "math/constants.h"
#include "math/finite.h"
#include "math/hash.h"
#include "math/octahedral.h"
#include "math/pack.h"
#include "math/sampling.h"
#include "math/sh.h"
#include "math/sobol.h"
#include "data/bvh.h"
#include "data/cascades.h"
#include "data/cell.h"
#include "data/engine_space.h"
#include "data/frame.h"
#include "data/gpu_bindings.h"
#include "data/hit.h"
#include "data/light.h"
#include "data/light_volume.h"
#include "data/picture.h"
#include "data/ray.h"
#include "data/ray_packed.h"
#include "data/rsm_texel.h"
#include "data/surface.h"
#include "stages/bricks.h"
#include "stages/deferred.h"
#include "stages/evaluate.h"
#include "stages/find_slot.h"
#include "stages/gather.h"
#include "stages/inject.h"
#include "stages/lookup.h"
#include "stages/map_face.h"
#include "stages/meet_triangle.h"
#include "stages/merge.h"
#include "stages/pick_texel.h"
#include "stages/ray_guide.h"
#include "stages/rays.h"
#include "stages/read_record.h"
#include "stages/record.h"
#include "stages/rsm.h"
#include "stages/rsm_from_faces.h"
#include "stages/slices.h"
#include "stages/surface.h"
#include "stages/texture.h"
#include "stages/trace.h"
#include "stages/trace_bvh.h"
#include "plan/cascade_placement.h"
#include "plan/cell_box.h"
#include "plan/direction_frame.h"
#include "plan/frame.h"
#include "plan/frame_check.h"
#include "plan/largest_flux.h"
#include "plan/light_frame.h"
#include "plan/map_faces.h"
#include "plan/needs.h"
#include "plan/number_check.h"
#include "plan/triangle_corners.h"
#include "cpu/aligned.h"
#include "cpu/block_pool.h"
#include "cpu/box_survey.h"
#include "cpu/brick_slots.h"
#include "cpu/build_level.h"
#include "cpu/cell_regions.h"
#include "cpu/evaluate.h"
#include "cpu/explain_reading.h"
#include "cpu/frame_rays.h"
#include "cpu/inject.h"
#include "cpu/level.h"
#include "cpu/level_choice.h"
#include "cpu/line_grid.h"
#include "cpu/lookup_table.h"
#include "cpu/moving_level.h"
#include "cpu/moving_lighting.h"
#include "cpu/moving_volume.h"
#include "cpu/packet_walk.h"
#include "cpu/parallel.h"
#include "cpu/partial_volume.h"
#include "cpu/picture_lookup.h"
#include "cpu/ray_guide.h"
#include "cpu/rays.h"
#include "cpu/region_tree.h"
#include "cpu/resolution.h"
#include "cpu/scene_probe.h"
#include "cpu/still_lighting.h"
#include "cpu/texel_sampler.h"
#include "cpu/texture_arrays.h"
#include "cpu/volume.h"
#include "cpu/walk_order.h"

#endif
