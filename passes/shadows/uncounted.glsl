// For techniques that count nothing of a lookup beside what passes/shadows/visibility.glsl counts.
void count_kernels() {}
