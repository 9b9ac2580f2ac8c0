#!/bin/sh
# Prints whether a job of the scheduler is running (or waits), ended with success, or failed.
case $(squeue --noheader --states=all --format=%T --jobs="$1" 2>&1) in
COMPLETED) echo success ;;
BOOT_FAIL | CANCELLED | DEADLINE | FAILED | NODE_FAIL | OUT_OF_MEMORY | PREEMPTED | TIMEOUT)
    echo failed
    ;;
*"Invalid job id"*) echo failed ;; # forgotten, as nobody asked for MinJobAge after its end
*) echo running ;;                 # also when the scheduler does not answer for a while
esac
