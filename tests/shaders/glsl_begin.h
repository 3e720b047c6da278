// Before texts of shaders/ that are included as C++: GLSL's qualifiers. No "pragma once":
// glsl_end.h takes them back, so that other headers can follow.
//
// `out` of an array needs none here; texts return what else they have to say as a struct.
#define uniform
#define in
#define out
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
