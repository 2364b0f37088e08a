/* The part of FMI 2.0 that a co-simulation master needs, as the standard defines it for C. */
#ifndef FMI2_H
#define FMI2_H

#include <stddef.h>

typedef void *fmi2Component, *fmi2FMUstate, *fmi2ComponentEnvironment;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef char fmi2Char, fmi2Byte;
typedef const fmi2Char *fmi2String;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/* Return type, name and arguments of every function. */
#define FMI2_FUNCTIONS(F) \
    F(const char *, GetTypesPlatform, (void)) \
    F(const char *, GetVersion, (void)) \
    F(fmi2Status, SetDebugLogging, (fmi2Component, fmi2Boolean, size_t, const fmi2String[])) \
    F(fmi2Component, Instantiate, (fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *, fmi2Boolean, fmi2Boolean)) \
    F(void, FreeInstance, (fmi2Component)) \
    F(fmi2Status, SetupExperiment, (fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real)) \
    F(fmi2Status, EnterInitializationMode, (fmi2Component)) \
    F(fmi2Status, ExitInitializationMode, (fmi2Component)) \
    F(fmi2Status, Terminate, (fmi2Component)) \
    F(fmi2Status, Reset, (fmi2Component)) \
    F(fmi2Status, GetReal, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[])) \
    F(fmi2Status, GetInteger, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[])) \
    F(fmi2Status, GetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[])) \
    F(fmi2Status, GetString, (fmi2Component, const fmi2ValueReference[], size_t, fmi2String[])) \
    F(fmi2Status, SetReal, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[])) \
    F(fmi2Status, SetInteger, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[])) \
    F(fmi2Status, SetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[])) \
    F(fmi2Status, SetString, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[])) \
    F(fmi2Status, GetFMUstate, (fmi2Component, fmi2FMUstate *)) \
    F(fmi2Status, SetFMUstate, (fmi2Component, fmi2FMUstate)) \
    F(fmi2Status, FreeFMUstate, (fmi2Component, fmi2FMUstate *)) \
    F(fmi2Status, SerializedFMUstateSize, (fmi2Component, fmi2FMUstate, size_t *)) \
    F(fmi2Status, SerializeFMUstate, (fmi2Component, fmi2FMUstate, fmi2Byte[], size_t)) \
    F(fmi2Status, DeSerializeFMUstate, (fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *)) \
    F(fmi2Status, GetDirectionalDerivative, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2ValueReference[], size_t, const fmi2Real[], fmi2Real[])) \
    F(fmi2Status, SetRealInputDerivatives, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], const fmi2Real[])) \
    F(fmi2Status, GetRealOutputDerivatives, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], fmi2Real[])) \
    F(fmi2Status, DoStep, (fmi2Component, fmi2Real, fmi2Real, fmi2Boolean)) \
    F(fmi2Status, CancelStep, (fmi2Component)) \
    F(fmi2Status, GetStatus, (fmi2Component, const fmi2StatusKind, fmi2Status *)) \
    F(fmi2Status, GetRealStatus, (fmi2Component, const fmi2StatusKind, fmi2Real *)) \
    F(fmi2Status, GetIntegerStatus, (fmi2Component, const fmi2StatusKind, fmi2Integer *)) \
    F(fmi2Status, GetBooleanStatus, (fmi2Component, const fmi2StatusKind, fmi2Boolean *)) \
    F(fmi2Status, GetStringStatus, (fmi2Component, const fmi2StatusKind, fmi2String *))

#endif
