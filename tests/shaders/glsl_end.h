// After texts that glsl_begin.h stands before.
#undef uniform
#undef in
#undef out
#pragma GCC diagnostic pop
