// The stage of a GPU invocation: one voxel. Takes the place of the march, so that a session that only knows frames runs
// it: the image is nx wide and ny nz high, and the voxel is its red channel.
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || row >= frame_height) return;
  float value = stage_voxel(x, row % stage_ny, row / stage_ny);
  int pixel = 2 * ((row - frame_band_y) * frame_width + x);
  dvr_out[pixel] = vec4(value, 0.0, 0.0, 0.0);
  dvr_out[pixel + 1] = vec4(0.0);
}
