/* Loads a library of the FMU as an importer does, walks into gross slip, and prints force and worn volume: for the emulators of other
 * platforms. Types are those of FMI 2.0 for every platform in use. Arguments: library, GUID, references of displacement, force, volume. */
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) ((void *)LoadLibraryA(path))
#define FIND(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

typedef void *Component;
typedef struct {
    void *logger, *allocate, *release, *step_finished, *environment;
} Callbacks;

static void *library;

static void *function(const char *name) {
    void *found = FIND(library, name);
    if (!found) {
        fprintf(stderr, "no function %s\n", name);
        exit(3);
    }
    return found;
}

static void check(int status, const char *what) {
    if (status > 1) {
        fprintf(stderr, "%s returned %d\n", what, status);
        exit(4);
    }
}

int main(int count, char **arguments) {
    if (count != 6) return 2;
    library = OPEN(arguments[1]);
    if (!library) {
        fprintf(stderr, "%s cannot be loaded\n", arguments[1]);
        return 3;
    }
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        (Component (*)(const char *, int, const char *, const char *, const Callbacks *, int, int))function("fmi2Instantiate");
    int (*setup)(Component, int, double, double, int, double) =
        (int (*)(Component, int, double, double, int, double))function("fmi2SetupExperiment");
    int (*enter)(Component) = (int (*)(Component))function("fmi2EnterInitializationMode");
    int (*leave)(Component) = (int (*)(Component))function("fmi2ExitInitializationMode");
    int (*set)(Component, const unsigned *, size_t, const double *) =
        (int (*)(Component, const unsigned *, size_t, const double *))function("fmi2SetReal");
    int (*get)(Component, const unsigned *, size_t, double *) =
        (int (*)(Component, const unsigned *, size_t, double *))function("fmi2GetReal");
    int (*step)(Component, double, double, int) = (int (*)(Component, double, double, int))function("fmi2DoStep");
    void (*release)(Component) = (void (*)(Component))function("fmi2FreeInstance");

    Callbacks callbacks = {0, 0, 0, 0, 0};
    unsigned motion = (unsigned)atoi(arguments[3]);
    unsigned read[2] = {(unsigned)atoi(arguments[4]), (unsigned)atoi(arguments[5])};
    double values[2] = {0, 0};
    Component contact = instantiate("loader", 1, arguments[2], 0, &callbacks, 0, 0);
    if (!contact) return 5;
    check(setup(contact, 0, 0, 0, 0, 0), "fmi2SetupExperiment");
    check(enter(contact), "fmi2EnterInitializationMode");
    check(leave(contact), "fmi2ExitInitializationMode");
    for (int k = 0; k < 8; k++) {
        double displacement = k % 2 ? -1e-5 : 1e-5;
        check(set(contact, &motion, 1, &displacement), "fmi2SetReal");
        check(step(contact, k, 1, 1), "fmi2DoStep");
    }
    check(get(contact, read, 2, values), "fmi2GetReal");
    release(contact);
    printf("%.12e %.12e\n", values[0], values[1]);
    return 0;
}
