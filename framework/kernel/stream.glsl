// What the march and the stream of its segments share: the ray in sampler coordinates, from its entry point.
vec3 stream_o, stream_d;
float stream_L = 0.0;
int stream_skipped = 0;
