/* An acknowledgement takes longer, as on a busy machine, by SLOW_ACKNOWLEDGEMENT_US: loaded before Fast DDS.
   Every removal of a writer that has to wait for one (TimedEvent::recreate_timer) writes a byte to BUSY_LOG. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

#define SEND _ZN8eprosima7fastdds4rtps14StatefulReader12send_acknackEPKNS1_11WriterProxyEPNS1_26RTPSMessageSenderInterfaceEb
#define RECREATE _ZN8eprosima7fastdds4rtps10TimedEvent14recreate_timerEv
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

static void *real(const char *name) { return dlsym(dlopen(getenv("FASTDDS_LIBRARY"), RTLD_LAZY), name); }

void SEND(void *reader, const void *writer, void *sender, bool final)
{
    static void (*send)(void *, const void *, void *, bool);
    if (!send) send = real(TEXT(SEND));
    send(reader, writer, sender, final);
    usleep(atoi(getenv("SLOW_ACKNOWLEDGEMENT_US")));
}

void RECREATE(void *event)
{
    static void (*recreate)(void *);
    static int log;
    if (!recreate) {
        recreate = real(TEXT(RECREATE));
        log = open(getenv("BUSY_LOG"), O_WRONLY | O_APPEND | O_CREAT, 0644);
    }
    if (write(log, "b", 1) < 0) log = -1;
    recreate(event);
}
