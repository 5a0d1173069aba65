/* SPDX-License-Identifier: MIT */
/* message.h - what the sandbox's child and its parent say to each other, over a pair of sockets
 * that keep messages apart. */
#ifndef LAMPION_SANDBOX_MESSAGE_H
#define LAMPION_SANDBOX_MESSAGE_H

#include "app/cli/cli.h"

typedef enum message_kind {
    MESSAGE_OPEN,     /* the child: open the file of this name */
    MESSAGE_FILE,     /* the parent: here it is */
    MESSAGE_PROGRESS, /* the child: this much of the work is done */
    MESSAGE_FAILURE   /* either: what went wrong */
} message_kind;

typedef struct message {
    unsigned char kind;
    char text[sizeof((cli_error *)0)->text];
} message;

/* Neither waits for the other side to make room. A descriptor may go with it; -1: none. */
bool message_send(int socket, message_kind kind, const char *text, int descriptor);

/* Waits for a message if `wait`; false if there is none. A descriptor is taken only where there is
 * room for it, and is -1 without one. */
bool message_receive(int socket, bool wait, message *m, int *descriptor);

#endif
