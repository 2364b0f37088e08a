/* A master in C: loads the library as a host does, and checks what it sees.
 *
 *   master <library> <guid> abi                   every function once, messages through a variadic logger
 *   master <library> <guid> many <count> <threads>   so many instances alive at once, each the bits of a run alone
 *   master <library> <guid> loop <count>          instances made and freed one after the other, with saved states
 *   master <library> <guid> reload <count>        the library loaded, run and unloaded so many times; memory must not grow
 *   master <library> <guid> save <file>           a run to its middle, the state into a file; prints what follows
 *   master <library> <guid> load <file>           takes the state from the file; prints what follows
 */
#define _GNU_SOURCE
#include "fmi2.h"
#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POINTER(result, name, arguments) static result(*name) arguments;
FMI2_FUNCTIONS(POINTER)

#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "%s:%d: %s; last message: %s\n", __FILE__, __LINE__, #condition, last_message); \
            exit(1); \
        } \
    } while (0)

/* Value references of modelDescription.xml. */
enum { NORMAL_FORCE, INDENTATION, DISPLACEMENT, AMPLITUDE, FREQUENCY, FORCE, VOLUME, DEPTH, WORK };
enum { SLIP_STATE = 16, PROFILE = 17, RADIUS = 18, PROFILE_FILE = 23, FRICTION = 28, WEAR = 29, RESOLUTION = 33 };

static __thread char last_message[2000] = "none";
static __thread int messages;
static const char *guid;

static void logger(void *environment, fmi2String instance, fmi2Status status, fmi2String category, fmi2String format, ...) {
    (void)status;
    va_list arguments;
    va_start(arguments, format);
    char text[1000];
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    snprintf(last_message, sizeof last_message, "%s %s %s %s", environment ? (char *)environment : "-", instance, category, text);
    messages++;
}

/* The struct of callbacks is gone when this returns. */
static fmi2Component make(const char *name, fmi2Boolean logging) {
    fmi2CallbackFunctions *functions = malloc(sizeof *functions);
    *functions = (fmi2CallbackFunctions){logger, calloc, free, NULL, "environment"};
    fmi2Component c = Instantiate(name, fmi2CoSimulation, guid, "file:///with%20blank/resources", functions, 0, logging);
    memset(functions, 0xAA, sizeof *functions);
    free(functions);
    return c;
}

static void start(fmi2Component c, double friction, double wear) {
    fmi2ValueReference resolution = RESOLUTION, reals[] = {FRICTION, WEAR};
    fmi2Integer cells = 16;
    fmi2Real values[] = {friction, wear};
    CHECK(SetInteger(c, &resolution, 1, &cells) == fmi2OK);
    CHECK(SetReal(c, reals, 2, values) == fmi2OK);
    CHECK(SetupExperiment(c, 1, 1e-3, 0, 1, 100) == fmi2OK);
    CHECK(EnterInitializationMode(c) == fmi2OK);
    CHECK(ExitInitializationMode(c) == fmi2OK);
}

static void step(fmi2Component c, int k, double force, double displacement) {
    fmi2ValueReference inputs[] = {NORMAL_FORCE, DISPLACEMENT};
    fmi2Real values[] = {force, displacement};
    CHECK(SetReal(c, inputs, 2, values) == fmi2OK);
    CHECK(DoStep(c, k, 1, 0) == fmi2OK);
}

typedef struct { fmi2Real values[4]; } Result;

static Result result(fmi2Component c) {
    fmi2ValueReference outputs[] = {FORCE, VOLUME, DEPTH, WORK};
    Result r;
    CHECK(GetReal(c, outputs, 4, r.values) == fmi2OK);
    return r;
}

/* Some steps of a scene, of which there are a few. */
#define SCENES 7
#define STEPS 6

static void begin(fmi2Component c, int scene) { start(c, 0.3 + 0.05 * scene, scene % 3 ? 0 : 1e-3); }

static void advance(fmi2Component c, int scene, int k) {
    step(c, k, 100 + 3 * scene - 2 * k, (k % 2 ? -1 : 1) * 1e-7 * (scene + 3 * k));
}

static void abi(void) {
    CHECK(!strcmp(GetVersion(), "2.0") && !strcmp(GetTypesPlatform(), "default"));
    fmi2CallbackFunctions functions = {logger, calloc, free, NULL, "environment"};
    CHECK(!Instantiate("other", fmi2CoSimulation, "{100 %s %d %n}", NULL, &functions, 0, 0));
    CHECK(strstr(last_message, "environment other logStatusError fmi2Instantiate: fmuGUID = {100 %s %d %n} is refused"));
    CHECK(!Instantiate("exchange", fmi2ModelExchange, guid, NULL, &functions, 0, 0) && strstr(last_message, "fmuType = 0"));

    fmi2Component c = make("a contact", 1);
    CHECK(c && strstr(last_message, "a contact logEvents"));
    fmi2String categories[] = {"logEvents", "logAll"};
    CHECK(SetDebugLogging(c, 0, 2, categories) == fmi2OK);
    fmi2ValueReference file = PROFILE_FILE, state = SLIP_STATE, radius = RADIUS;
    fmi2String text = "no %s file %n";
    CHECK(SetString(c, &file, 1, &text) == fmi2OK);
    CHECK(GetString(c, &file, 1, &text) == fmi2Error); /* not before the initialization mode */
    fmi2Real value = -1;
    CHECK(SetReal(c, &radius, 1, &value) == fmi2Error && strstr(last_message, "radius = -1.0 is refused"));
    CHECK(SetBoolean(c, NULL, 0, NULL) == fmi2OK);
    start(c, 0.6, 1e-3);
    CHECK(GetString(c, &file, 1, &text) == fmi2OK && !strcmp(text, "no %s file %n"));
    CHECK(GetBoolean(c, NULL, 0, NULL) == fmi2OK);
    step(c, 0, 100, 1e-6);

    fmi2FMUstate saved = NULL, copy = NULL;
    CHECK(GetFMUstate(c, &saved) == fmi2OK && saved);
    size_t size = 0;
    CHECK(SerializedFMUstateSize(c, saved, &size) == fmi2OK && size > 0);
    fmi2Byte *bytes = malloc(size);
    CHECK(SerializeFMUstate(c, saved, bytes, size) == fmi2OK);
    CHECK(DeSerializeFMUstate(c, bytes, size, &copy) == fmi2OK && copy && copy != saved);
    step(c, 1, 90, 1e-5);
    Result first = result(c);
    CHECK(first.values[0] > 53.9 && first.values[0] < 54.1); /* gross slip: 0.6 * 90 N */
    fmi2Integer slip = 0;
    CHECK(GetInteger(c, &state, 1, &slip) == fmi2OK && slip == 4);
    CHECK(SetFMUstate(c, copy) == fmi2OK);
    step(c, 1, 90, 1e-5);
    Result again = result(c);
    CHECK(!memcmp(&first, &again, sizeof first));
    CHECK(FreeFMUstate(c, &saved) == fmi2OK && !saved && FreeFMUstate(c, &copy) == fmi2OK && !copy);
    free(bytes);

    fmi2ValueReference input = DISPLACEMENT, output = FORCE;
    fmi2Real seed = 1, slope = 7;
    CHECK(GetDirectionalDerivative(c, &output, 1, &input, 1, &seed, &slope) == fmi2OK && slope == 0); /* it slips */
    fmi2Integer order = 1;
    fmi2Real rate = -1e-6;
    CHECK(SetRealInputDerivatives(c, &input, 1, &order, &rate) == fmi2OK);
    CHECK(DoStep(c, 2, 1, 1) == fmi2OK);
    CHECK(GetReal(c, &input, 1, &value) == fmi2OK && value == 1e-5 - 1e-6);
    CHECK(GetRealOutputDerivatives(c, &output, 1, &order, &slope) == fmi2OK && slope < 0);

    fmi2Status status;
    fmi2Boolean ended = 7;
    fmi2Integer number;
    fmi2String pending;
    CHECK(GetStatus(c, fmi2DoStepStatus, &status) == fmi2OK && status == fmi2OK);
    CHECK(GetRealStatus(c, fmi2LastSuccessfulTime, &value) == fmi2OK && value == 3);
    CHECK(GetBooleanStatus(c, fmi2Terminated, &ended) == fmi2OK && !ended);
    CHECK(GetStringStatus(c, fmi2PendingStatus, &pending) == fmi2OK && pending);
    CHECK(GetIntegerStatus(c, fmi2DoStepStatus, &number) == fmi2Discard);
    CHECK(CancelStep(c) == fmi2Error);
    int before = messages;
    CHECK(DoStep(c, 2, 1, 1) == fmi2Error && messages == before + 1 && strstr(last_message, "the last step ended at 3"));
    CHECK(Terminate(c) == fmi2OK && Reset(c) == fmi2OK);
    FreeInstance(c);
    FreeInstance(NULL);
}

static Result alone[SCENES];
static fmi2Component *crowd;
static int count, threads;

/* Every instance of one thread in turn, a step at a time, so that all are active within a run at the same time. */
static void *drive(void *first) {
    for (int k = 0; k < STEPS; k++)
        for (int i = (int)(size_t)first; i < count; i += threads) {
            if (k == 0) {
                crowd[i] = i % 2 ? make("one of many", i % 4 == 1) : Instantiate("silent", fmi2CoSimulation, guid, NULL, NULL, 0, 0);
                CHECK(crowd[i]);
                begin(crowd[i], i % SCENES);
            }
            advance(crowd[i], i % SCENES, k);
        }
    return NULL;
}

static void *finish(void *first) {
    for (int i = (int)(size_t)first; i < count; i += threads) {
        Result r = result(crowd[i]);
        CHECK(!memcmp(&r, &alone[i % SCENES], sizeof r));
        FreeInstance(crowd[i]);
    }
    return NULL;
}

static void many(void) {
    for (int scene = 0; scene < SCENES; scene++) {
        fmi2Component c = make("alone", 0);
        begin(c, scene);
        for (int k = 0; k < STEPS; k++) advance(c, scene, k);
        alone[scene] = result(c);
        FreeInstance(c);
    }
    crowd = calloc(count, sizeof *crowd);
    pthread_t *ids = calloc(threads, sizeof *ids);
    void *(*phases[])(void *) = {drive, finish};
    for (int phase = 0; phase < 2; phase++) {
        for (int t = 0; t < threads; t++) CHECK(!pthread_create(&ids[t], NULL, phases[phase], (void *)(size_t)t));
        for (int t = 0; t < threads; t++) CHECK(!pthread_join(ids[t], NULL));
    }
    free(ids);
    free(crowd);
}

static void loop(void) {
    for (int i = 0; i < count; i++) {
        fmi2Component c = make("again", i % 2);
        begin(c, i % SCENES);
        fmi2FMUstate kept = NULL, freed = NULL;
        for (int k = 0; k < 3; k++) {
            advance(c, i % SCENES, k);
            CHECK(GetFMUstate(c, k ? &kept : &freed) == fmi2OK);
        }
        CHECK(SetFMUstate(c, freed) == fmi2OK && FreeFMUstate(c, &freed) == fmi2OK);
        if (i % 3 == 0) CHECK(Terminate(c) == fmi2OK && Reset(c) == fmi2OK);
        FreeInstance(c); /* with a state that is still kept, in any state of its life */
    }
}

static void *open_library(const char *path) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
#define LOAD(result, name, arguments) CHECK((*(void **)&name = dlsym(library, "fmi2" #name)));
    FMI2_FUNCTIONS(LOAD)
    return library;
}

/* A wearing run in a thread of its own, since a library with thread-local memory stays until its threads have ended. */
static void *run_once(void *scene) {
    fmi2Component c = make("loaded", 0);
    begin(c, (int)(size_t)scene);
    for (int k = 0; k < STEPS; k++) advance(c, (int)(size_t)scene, k);
    result(c);
    CHECK(Terminate(c) == fmi2OK);
    FreeInstance(c);
    return NULL;
}

/* Bytes that have been asked for and not given back. */
static size_t in_use(void) { return mallinfo2().uordblks; }

static void reload(const char *path) {
    size_t before = 0, unloaded = 0;
    for (int i = 0; i < count; i++) {
        void *library = open_library(path);
        pthread_t id;
        CHECK(!pthread_create(&id, NULL, run_once, (void *)(size_t)(i % SCENES)) && !pthread_join(id, NULL));
        CHECK(!dlclose(library));
        void *left = dlopen(path, RTLD_NOW | RTLD_NOLOAD);
        if (left) dlclose(left);
        unloaded += !left;
        /* the first rounds fill the caches of the C library */
        if (i == count / 10) before = in_use();
    }
    size_t after = in_use();
    printf("%d rounds, unloaded in %zu: %zu bytes in use after a tenth of them, %zu at the end\n", count, unloaded, before, after);
    CHECK(unloaded == (size_t)count);
    CHECK(after <= before + 1000);
}

static void go_on(fmi2Component c) {
    for (int k = 3; k < STEPS; k++) advance(c, 3, k);
    Result r = result(c);
    for (int i = 0; i < 4; i++) printf("%a\n", r.values[i]);
    FreeInstance(c);
}

static void save(const char *path) {
    fmi2Component c = make("saving", 0);
    begin(c, 3);
    for (int k = 0; k < 3; k++) advance(c, 3, k);
    fmi2FMUstate state = NULL;
    size_t size = 0;
    CHECK(GetFMUstate(c, &state) == fmi2OK && SerializedFMUstateSize(c, state, &size) == fmi2OK);
    fmi2Byte *bytes = malloc(size);
    CHECK(SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    FILE *file = fopen(path, "wb");
    CHECK(file && fwrite(bytes, 1, size, file) == size && !fclose(file));
    free(bytes);
    go_on(c);
}

static void load(const char *path) {
    FILE *file = fopen(path, "rb");
    CHECK(file);
    static fmi2Byte bytes[1 << 20];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    fmi2Component c = make("loading", 0);
    fmi2FMUstate state = NULL;
    CHECK(DeSerializeFMUstate(c, bytes, size, &state) == fmi2OK && SetFMUstate(c, state) == fmi2OK);
    go_on(c);
}

int main(int argc, char **argv) {
    CHECK(argc >= 4);
    guid = argv[2];
    const char *task = argv[3];
    count = argc > 4 ? atoi(argv[4]) : 0;
    threads = argc > 5 ? atoi(argv[5]) : 1;
    if (!strcmp(task, "reload")) {
        reload(argv[1]);
        return 0;
    }
    open_library(argv[1]);
    if (!strcmp(task, "abi")) abi();
    else if (!strcmp(task, "many")) many();
    else if (!strcmp(task, "loop")) loop();
    else if (!strcmp(task, "save") && argc > 4) save(argv[4]);
    else if (!strcmp(task, "load") && argc > 4) load(argv[4]);
    else CHECK(!"a known task");
    return 0;
}
