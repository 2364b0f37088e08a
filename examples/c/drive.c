/* The FMU from C: loads its library, walks a loop and reads the worn volume.
 *
 *   unzip -d contact FrettingContact.fmu
 *   cc -I <FMI 2.0 headers> drive.c -ldl -o drive && ./drive contact
 *
 * The headers are those of the FMI standard (fmi-standard.org); the Python package fmpy has them in its folder c-code.
 */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2FunctionTypes.h"

#define CALL(what) do { if ((what) > fmi2Warning) { fprintf(stderr, "failed: " #what "\n"); exit(1); } } while (0)

static void print_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                          fmi2String category, fmi2String message, ...) {
    (void)environment;
    fprintf(stderr, "%s, status %d, %s: %s\n", instance, (int)status, category, message);
}

/* The text between `before` and the next quote in a file; used for what modelDescription.xml says. */
static char *between(const char *text, const char *before) {
    const char *start = strstr(text, before);
    if (!start) { fprintf(stderr, "no %s\n", before); exit(1); }
    start += strlen(before);
    return strndup(start, strcspn(start, "\""));
}

static fmi2ValueReference reference(const char *description, const char *name) {
    char *tag = malloc(strlen(name) + 32);
    sprintf(tag, "name=\"%s\" valueReference=\"", name);
    return (fmi2ValueReference)strtoul(between(description, tag), NULL, 10);
}

static void *function(void *library, const char *name) {
    void *found = dlsym(library, name);
    if (!found) { fprintf(stderr, "no %s: %s\n", name, dlerror()); exit(1); }
    return found;
}

int main(int count, char **arguments) {
    if (count != 2) { fprintf(stderr, "usage: drive <folder of the unpacked FMU>\n"); return 2; }
    char path[4096], description[1 << 20];
    snprintf(path, sizeof path, "%s/modelDescription.xml", arguments[1]);
    FILE *file = fopen(path, "r");
    if (!file) { perror(path); return 1; }
    description[fread(description, 1, sizeof description - 1, file)] = 0;
    fclose(file);
    snprintf(path, sizeof path, "%s/binaries/linux64/FrettingContact.so", arguments[1]);
    void *library = dlopen(path, RTLD_NOW);
    if (!library) { fprintf(stderr, "%s\n", dlerror()); return 1; }

    fmi2InstantiateTYPE *instantiate = (fmi2InstantiateTYPE *)function(library, "fmi2Instantiate");
    fmi2SetupExperimentTYPE *setup = (fmi2SetupExperimentTYPE *)function(library, "fmi2SetupExperiment");
    fmi2EnterInitializationModeTYPE *enter =
        (fmi2EnterInitializationModeTYPE *)function(library, "fmi2EnterInitializationMode");
    fmi2ExitInitializationModeTYPE *leave =
        (fmi2ExitInitializationModeTYPE *)function(library, "fmi2ExitInitializationMode");
    fmi2SetRealTYPE *set = (fmi2SetRealTYPE *)function(library, "fmi2SetReal");
    fmi2GetRealTYPE *get = (fmi2GetRealTYPE *)function(library, "fmi2GetReal");
    fmi2DoStepTYPE *step = (fmi2DoStepTYPE *)function(library, "fmi2DoStep");
    fmi2FreeInstanceTYPE *release = (fmi2FreeInstanceTYPE *)function(library, "fmi2FreeInstance");

    /* memory is the FMU's own business: the functions for it may be null */
    fmi2CallbackFunctions callbacks = {print_message, NULL, NULL, NULL, NULL};
    fmi2Component contact = instantiate("ball", fmi2CoSimulation, between(description, "guid=\""), NULL, &callbacks,
                                        fmi2False, fmi2False);
    if (!contact) return 1;
    fmi2ValueReference motion = reference(description, "tangential_displacement");
    fmi2ValueReference read[] = {reference(description, "tangential_force"), reference(description, "wear_volume")};
    CALL(setup(contact, fmi2False, 0, 0, fmi2False, 0));
    CALL(enter(contact));
    CALL(leave(contact));
    fmi2Real values[2], time = 0, h = 0.01;
    for (int k = 1; k <= 100; k++, time += h) {
        fmi2Real displacement = 2e-6 * sin(2 * 3.14159265358979323846 * k * h);
        CALL(set(contact, &motion, 1, &displacement));
        CALL(step(contact, time, h, fmi2True));
        CALL(get(contact, read, 2, values));
        if (k % 25 == 0) printf("t = %.2f s   U = %+.2e m   T = %+.4f N\n", time + h, displacement, values[0]);
    }
    printf("worn volume          %.4e m3\n", values[1]);
    release(contact);
    return 0;
}
