/* The rain of rain.mjs in a native program, through the same C interface: ns for each body and step, and the state's hash.
   Usage: native SCENE WARM STEPS */
#include <elastoon/elastoon.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static char* readFile(const char* name, size_t* out_size) {
    FILE* file = fopen(name, "rb");
    if (file == NULL) {
        return NULL;
    }
    fseek(file, 0, SEEK_END);
    *out_size = (size_t)ftell(file);
    rewind(file);
    char* text = malloc(*out_size + 1);
    if (text == NULL || fread(text, 1, *out_size, file) != *out_size) {
        *out_size = 0;
    }
    fclose(file);
    return text;
}

int main(int argc, char** argv) {
    ElastoonScene scene;
    ElastoonWorld world;
    size_t size = 0, count = 0;
    char* text = argc == 4 ? readFile(argv[1], &size) : NULL;
    if (text == NULL || elastoonSceneParse(text, size, argv[1], &scene) || elastoonSceneStage(scene, &world)) {
        fprintf(stderr, "%s\n", elastoonLastError());
        return 1;
    }
    const int warm = atoi(argv[2]), steps = atoi(argv[3]);
    double start = 0.0;
    for (int step = 0; step < warm + steps; ++step) {
        const float* matrices;
        if (step == warm) {
            start = now();
        }
        elastoonWorldStep(world, 1.0 / 60.0);
        elastoonWorldMatricesView(world, &matrices, &count);
    }
    uint64_t hash = 0;
    const double taken = now() - start;
    elastoonWorldStateHash(world, &hash);
    printf("%.1f %016" PRIx64 "\n", 1e9 * taken / steps / (double)count, hash);
    free(text);
    return 0;
}
