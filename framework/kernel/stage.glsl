// A stage of a light volume as a GPU invocation: one voxel. Rows of the volume are numbered y first, then z; each leaves its
// channels one behind the other. The CPU calls the same function row by row (framework/kernel/cpu/stage_variant.h).
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || row >= frame_height) return;
  vec4 v = stage_voxel(x, row % stage_ny, row / stage_ny);
  int at = (row - frame_band_y) * stage_channels * frame_width + x;
  dvr_out[at] = v.x;
  if (stage_channels > 1) dvr_out[at + frame_width] = v.y;
  if (stage_channels > 2) dvr_out[at + 2 * frame_width] = v.z;
  if (stage_channels > 3) dvr_out[at + 3 * frame_width] = v.w;
}
