/* A stand-in for the system library of this name, which Windows has and Wine 8 lacks: Rust's
   standard library takes its random numbers from it. Only for trying the library out under such a
   Wine; it is not packaged. */
#include <windows.h>
#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(unsigned char *data, SIZE_T size)
{
    return RtlGenRandom(data, (ULONG)size);
}
