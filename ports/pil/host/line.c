/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* cfmakeraw, speeds above 38400 baud */
#include "line.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

double line_seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- a serial port -------------------------------------------------------------------------------------- */

static const struct {
    unsigned long baud;
    speed_t speed;
} speeds[] = {
    {9600, B9600},     {19200, B19200},   {38400, B38400}, {57600, B57600}, {115200, B115200}, {230400, B230400},
#ifdef B921600
    {460800, B460800}, {921600, B921600},
#endif
};

static int find_speed(unsigned long baud, speed_t *speed)
{
    for (unsigned i = 0; i < sizeof speeds / sizeof speeds[0]; i++)
        if (speeds[i].baud == baud) {
            *speed = speeds[i].speed;
            return 0;
        }
    fprintf(stderr, "%lu baud: expected 9600, 19200, 38400, 57600, 115200, 230400, 460800 or 921600\n", baud);
    return -1;
}

/* Bytes as they are: no echo, no signals, no translation; no wires but the two for data. */
static int set_up(int file, speed_t speed)
{
    struct termios settings;

    if (tcgetattr(file, &settings) != 0)
        return -1;
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    if (cfsetispeed(&settings, speed) != 0 || cfsetospeed(&settings, speed) != 0)
        return -1;
    return tcsetattr(file, TCSANOW, &settings) == 0 && tcflush(file, TCIOFLUSH) == 0 ? 0 : -1;
}

int line_open(line_t *line, const char *device, unsigned long baud)
{
    speed_t speed;

    if (find_speed(baud, &speed) != 0)
        return -1;
    line->program = 0;
    line->file = open(device, O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (line->file >= 0 && set_up(line->file, speed) == 0)
        return 0;
    fprintf(stderr, "%s cannot be used as a serial port: %s\n", device, strerror(errno));
    line_close(line);
    return -1;
}

/* ---- a program ------------------------------------------------------------------------------------------ */

static void become(char *const command[], int file)
{
    if (dup2(file, STDIN_FILENO) >= 0 && dup2(file, STDOUT_FILENO) >= 0)
        execvp(command[0], command);
    fprintf(stderr, "%s cannot be run: %s\n", command[0], strerror(errno));
    _exit(127);
}

int line_start(line_t *line, char *const command[])
{
    int ends[2];

    line->file = -1;
    line->program = 0;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0 || (line->program = fork()) < 0) {
        fprintf(stderr, "%s cannot be run: %s\n", command[0], strerror(errno));
        line->program = 0;
        return -1;
    }
    if (line->program == 0) {
        close(ends[0]);
        become(command, ends[1]);
    }
    close(ends[1]);
    signal(SIGPIPE, SIG_IGN);
    line->file = ends[0];
    fcntl(line->file, F_SETFL, O_NONBLOCK);
    return 0;
}

static void say_how_it_ended(pid_t program)
{
    int status;

    if (waitpid(program, &status, 0) != program)
        return;
    if (WIFEXITED(status))
        fprintf(stderr, "The target's program has ended with status %d.\n", WEXITSTATUS(status));
    else if (WIFSIGNALED(status))
        fprintf(stderr, "The target's program has ended by signal %d.\n", WTERMSIG(status));
}

void line_close(line_t *line)
{
    if (line->file >= 0)
        close(line->file);
    if (line->program > 0) {
        kill(line->program, SIGKILL);
        waitpid(line->program, NULL, 0);
    }
    line->file = -1;
    line->program = 0;
}

/* ---- bytes ---------------------------------------------------------------------------------------------- */

static int is_ready(int file, short event, double seconds)
{
    struct pollfd poll_file = {.fd = file, .events = event};

    return poll(&poll_file, 1, (int)(1000.0 * seconds + 0.999)) > 0;
}

int line_write(line_t *line, const uint8_t *bytes, unsigned count)
{
    while (count > 0) {
        const ssize_t written = write(line->file, bytes, count);

        if (written > 0) {
            bytes += written;
            count -= (unsigned)written;
        } else if (written == 0 || (errno != EAGAIN && errno != EINTR) || !is_ready(line->file, POLLOUT, 1.0)) {
            return -1;
        }
    }
    return 0;
}

line_result line_read(line_t *line, uint8_t *byte, double seconds)
{
    const double end = line_seconds() + seconds;
    double left = seconds;

    do {
        const int ready = is_ready(line->file, POLLIN, left > 0.0 ? left : 0.0);
        const ssize_t count = ready ? read(line->file, byte, 1) : -1;

        if (count == 1)
            return LINE_BYTE;
        if (ready && (count == 0 || (errno != EAGAIN && errno != EINTR))) {
            if (line->program > 0)
                say_how_it_ended(line->program);
            line->program = 0;
            return LINE_BROKEN;
        }
        left = end - line_seconds();
    } while (left > 0.0);
    return LINE_TIMEOUT;
}
