#!/usr/bin/env python3
"""A monkey at the real window under Xvfb: 20 random events a second by xdotool, for so many seconds.

usage: tests/monkey.py PROGRAM [SECONDS=600] [SEED=1]

PROGRAM is best one of the `debug` preset (address and undefined-behaviour sanitizers) or of `threads`
(with TSAN_OPTIONS=suppressions=.../tests/threads.supp). Prints the events sent, the program's peak
memory, the longest time in which the window recorded no event, and how it ended. Exit code 1: it
crashed, hung for 5 s or took more than 600 MB (2000 with TSan); 77: Xvfb or xdotool is missing. The
recording of what was done stays in the folder that is named last, for `view --play`.
"""
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

PRESET = """title = "small"
[footprint]
rods = 6
radius_mm = 66.0
[actuation]
radius_mm = 54.0
"""
KEYS = ("j g h r space Left Right Home 1 2 3 n i d c s o p Tab ctrl+z ctrl+y ctrl+s ctrl+p ctrl+d "
        "ctrl+c Escape F1 Return plus minus b w v Prior Next 4 8 ctrl+Left ctrl+f ctrl+e").split()
EVERY_S, LONGEST_S = 0.05, 5
MOST_MB = 2000 if "TSAN_OPTIONS" in os.environ else 600  # the thread sanitizer has memory of its own


def commands(seed):
    """Commands for xdotool, without end; a button is released before it is pressed again."""
    draw, down = random.Random(seed), False
    while True:
        kind = draw.randrange(10)
        if kind < 6:
            anywhere = draw.random() < 0.4
            x, y = ((draw.randrange(1280), draw.randrange(720)) if anywhere else
                    (440 + draw.randrange(400), 200 + draw.randrange(320)))
            yield f"mousemove {x} {y}"
        elif kind < 8:
            down = not down
            yield "mousedown 1" if down else "mouseup 1"
        elif kind < 9:
            yield f"click {draw.choice('45')}"
        else:
            yield f"key {draw.choice(KEYS)}"


def peak_MB(pid):
    with open(f"/proc/{pid}/status") as status:
        return next(int(line.split()[1]) // 1024 for line in status if line.startswith("VmHWM"))


def play(view, hand, seconds, seed):
    """Events sent, peak of memory in MB (0 if the program ended), longest pause of the recording in
    seconds."""
    begin = last = time.time()
    sent = size = 0
    pause = 0.0
    for command in commands(seed):
        if time.time() - begin > seconds or view.poll() is not None:
            peak = peak_MB(view.pid) if view.poll() is None else 0
            return sent, peak, max(pause, time.time() - last)
        hand.stdin.write(command + "\n")
        sent += 1
        time.sleep(max(0, begin + sent * EVERY_S - time.time()))
        now = os.path.getsize("visit.txt") if os.path.exists("visit.txt") else 0
        if now != size:
            pause, size, last = max(pause, time.time() - last), now, time.time()


def main():
    program = os.path.realpath(sys.argv[1])
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 600
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    for tool in ("Xvfb", "xdotool"):
        if not shutil.which(tool):
            print(f"no {tool}: skipped")
            return 77
    os.chdir(tempfile.mkdtemp(prefix="monkey-"))
    with open("small.toml", "w") as preset:
        preset.write(PRESET)
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x720x24"],
                              pass_fds=[writing], stderr=subprocess.DEVNULL)
    display = os.read(reading, 16).decode().strip()
    env = dict(os.environ, DISPLAY=f":{display}",
               ASAN_OPTIONS="detect_leaks=0:quarantine_size_mb=32")
    try:
        with open("error.txt", "w") as error:
            view = subprocess.Popen([program, "view", "small.toml", "--record", "visit.txt",
                                     "--workspace", "desk.json", "-o", "kept"],
                                    env=env, stderr=error, stdout=subprocess.DEVNULL)
        found = subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name",
                                "^gridshell$"], env=env, capture_output=True, text=True, check=True)
        subprocess.run(["xdotool", "windowfocus", found.stdout.split()[0]], env=env, check=True)
        time.sleep(5)  # the first shell forms
        hand = subprocess.Popen(["xdotool", "-"], env=env, stdin=subprocess.PIPE, text=True,
                                bufsize=1)
        sent, peak, pause = play(view, hand, seconds, seed)
        hand.stdin.write("mouseup 1\nkey Escape\nkey Escape\nkey ctrl+q\n")
        hand.stdin.close()
        try:
            code = view.wait(60)
        except subprocess.TimeoutExpired:
            view.kill()
            code = "none: it did not quit"
    finally:
        server.terminate()
    print(f"{sent} events, peak {peak} MB, longest pause {pause:.2f} s, exit code {code}, "
          f"in {os.getcwd()}")
    with open("error.txt") as error:
        print(error.read()[-2000:], end="")
    return int(code != 0 or pause > LONGEST_S or peak > MOST_MB)


if __name__ == "__main__":
    sys.exit(main())
