/* fenced.c - each room ends where a page begins that nobody may touch.  Under ASan, which has red zones of its own, it is calloc.
 *
 * Mapping memory costs more than a small call of the kernel, so that rooms that were left are used again. */
#include "fenced.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__

void *fenced_room(int64_t n, int64_t size)
{
    void *room = calloc(n > 0 ? (size_t)n : 1, (size_t)size);
    if (!room) abort();
    return room;
}

void fenced_leave(void *room) { free(room); }

#else

#define SIZES 48 /* powers of two, in pages */

/* Stands at the begin of its mapping; the room at the end, before the fence. */
typedef struct mapping {
    struct mapping *next;
    int power;
} mapping;

static pthread_mutex_t door = PTHREAD_MUTEX_INITIALIZER;
static mapping *left[SIZES];

static mapping *mapped(int power, size_t page)
{
    const size_t bytes = page << power;
    char *x = mmap(NULL, bytes + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (x == MAP_FAILED || mprotect(x + bytes, page, PROT_NONE)) abort();
    mapping *m = (mapping *)x;
    m->power = power;
    return m;
}

void *fenced_room(int64_t n, int64_t size)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), bytes = n > 0 ? (size_t)(n * size) : 0;
    int power = 0;
    while (power < SIZES && page << power < bytes + sizeof(mapping) + sizeof(void *)) power++;
    if (power == SIZES) abort();
    pthread_mutex_lock(&door);
    mapping *m = left[power];
    if (m) left[power] = m->next;
    pthread_mutex_unlock(&door);
    if (!m) m = mapped(power, page);
    char *room = (char *)m + (page << power) - bytes;
    memcpy(room - sizeof m, &m, sizeof m); /* the way back */
    return memset(room, 0, bytes);
}

void fenced_leave(void *room)
{
    if (!room) return;
    mapping *m;
    memcpy(&m, (char *)room - sizeof m, sizeof m);
    pthread_mutex_lock(&door);
    m->next = left[m->power];
    left[m->power] = m;
    pthread_mutex_unlock(&door);
}

#endif
