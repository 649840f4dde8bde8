// Cuts rays by ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "clv/data/frame.h"
#include "clv/data/ray.h"
#include "query.glsl"
#include "work_group.glsl"
#include "trace.glsl"
