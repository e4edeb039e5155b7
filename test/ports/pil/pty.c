/* SPDX-License-Identifier: MIT */
/* Runs a target at the far end of a pseudo-terminal, as a board is at that of a serial port:
 *
 *     pty TARGET PROGRAM…        with `--port DEVICE` added to PROGRAM */
#define _XOPEN_SOURCE 700
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ARGUMENTS_MAX = 30, CANNOT = 125 };

static int stop(const char *what)
{
    perror(what);
    return CANNOT;
}

static pid_t run(char *const command[], int line)
{
    const pid_t program = fork();

    if (program != 0)
        return program;
    if (line >= 0 && (dup2(line, STDIN_FILENO) < 0 || dup2(line, STDOUT_FILENO) < 0))
        _exit(CANNOT);
    execvp(command[0], command);
    _exit(CANNOT);
}

static int status_of(pid_t program)
{
    int status;

    return waitpid(program, &status, 0) == program && WIFEXITED(status) ? WEXITSTATUS(status) : CANNOT;
}

int main(int argc, char **argv)
{
    const int board = posix_openpt(O_RDWR | O_NOCTTY);
    char *target[2] = {argv[1], NULL}, *program[ARGUMENTS_MAX + 3];
    char port[] = "--port";
    pid_t target_program;
    int pc, status;

    if (argc < 3 || argc > ARGUMENTS_MAX || board < 0 || grantpt(board) != 0 || unlockpt(board) != 0)
        return stop("pty");
    pc = open(ptsname(board),
              O_RDWR | O_NOCTTY); /* as long as nobody has it open the target would hear of a broken line */
    if (pc < 0)
        return stop(ptsname(board));
    for (int i = 2; i < argc; i++)
        program[i - 2] = argv[i];
    program[argc - 2] = port;
    program[argc - 1] = ptsname(board);
    program[argc] = NULL;

    target_program = run(target, board);
    if (target_program < 0)
        return stop(target[0]);
    status = status_of(run(program, -1));
    kill(target_program, SIGKILL);
    status_of(target_program);
    return status;
}
