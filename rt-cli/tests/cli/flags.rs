//! The command line itself: help, and what is no command.

use crate::support::Scratch;

#[test]
fn help_fits_a_terminal_and_names_groups_and_defaults() {
    let scratch = Scratch::new();
    for command in [
        &[][..],
        &["render"],
        &["info"],
        &["gen"],
        &["bench"],
        &["accuracy"],
        &["chart"],
        &["compare"],
        &["convert"],
        &["completions"],
        &["paper"],
    ] {
        for flag in ["-h", "--help"] {
            let help = scratch.rt(&[command, &[flag]].concat()).exits(0).text();
            let long = help.lines().find(|line| line.chars().count() > 80);
            assert_eq!(long, None, "{command:?}");
            assert!(help.contains("Usage: rt"), "{help}");
        }
    }
    let help = scratch.rt(&["render", "-h"]).exits(0).text();
    for heading in [
        "\nPicture:\n",
        "\nShading:\n",
        "\nPrecision:\n",
        "\nMachine (",
        "\nLong jobs:\n",
        "\nTalk:\n",
        "\nExamples:\n",
    ] {
        assert!(help.contains(heading), "{heading:?} in\n{help}");
    }
    let flowing = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for (flag, default) in [
        ("--size", "the scene's, or 512x512"),
        ("--crop", "all"),
        ("--eye", "the scene's, or such that all is in the picture"),
        ("--target", "the scene's, or the middle of its bounds"),
        ("--up", "the scene's, or 0,1,0"),
        ("--fov", "the scene's, or 40"),
        ("--light", "the scene's, or one at the eye"),
        ("--background", "the scene's, or 0.05,0.05,0.06"),
        ("--integrator", "whitted"),
        ("--depth", "5"),
        ("--kernel", "watertight"),
        ("--tolerance", "none, which is 0"),
        ("--isa", "auto"),
        ("--packet", "native"),
        ("--threads", "one a core"),
        ("--accel", "bvh"),
        ("--builder", "binned-sah"),
        ("--layout", "bvh8"),
        ("--progress", "auto"),
    ] {
        let from = flowing.find(&format!("{flag} <")).expect(flag);
        let about = &flowing[from..];
        let about = &about[..about[2..].find(" --").map_or(about.len(), |next| next + 2)];
        assert!(about.contains(&format!("[default: {default}]")), "{flag}: {about}");
    }
}

#[test]
fn help_is_a_command_too() {
    let scratch = Scratch::new();
    assert_eq!(scratch.rt(&["help"]).exits(0).text(), scratch.rt(&["--help"]).exits(0).text());
    let render = scratch.rt(&["help", "render"]).exits(0).text();
    assert_eq!(render, scratch.rt(&["render", "--help"]).exits(0).text());
}

#[test]
fn the_version_is_told() {
    let run = Scratch::new().rt(&["--version"]).exits(0);
    assert_eq!(run.text(), concat!("rt ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn wrong_usage_is_exit_code_2_and_does_nothing() {
    let scratch = Scratch::with_room();
    for args in [
        "",
        "paint room.obj",
        "render",
        "render room.obj",
        "render -o a.png",
        "render room.obj -o",
        "render room.obj more.obj -o a.png",
        "render room.obj -o a.png --colour red",
        "render room.obj -o a.png -s 0x10",
        "render room.obj -o a.png -s 10x0",
        "render room.obj -o a.png -s 10",
        "render room.obj -o a.png -s 10x-5",
        "render room.obj -o a.png -s 4294967296x1",
        "render room.obj -o a.png --eye 1,2",
        "render room.obj -o a.png --eye 1,2,nan",
        "render room.obj -o a.png --target 1,2,1e39",
        "render room.obj -o a.png --up x",
        "render room.obj -o a.png --fov 0",
        "render room.obj -o a.png --fov 180",
        "render room.obj -o a.png --light 1,2,3,4",
        "render room.obj -o a.png --background 1,-1,0",
        "render room.obj -o a.png --integrator path",
        "render room.obj -o a.png --depth -1",
        "render room.obj -o a.png --isa sse9",
        "render room.obj -o a.png --packet 3",
        "render room.obj -o a.png -j 0",
        "render room.obj -o a.png -j 70000",
        "render room.obj -o a.png --accel octree",
        "render room.obj -o a.png --builder best",
        "render room.obj -o a.png --layout bvh2",
        "render room.obj -o a.png --progress dots",
        "render room.obj -o a.png --crop 1,2,3",
        "render room.obj -o a.png --bits 10",
        "render room.obj -o a.png -q -v",
        "render room.obj -o a.png --kernel pluecker",
        "render room.obj -o a.png --tolerance",
        "render room.obj -o a.png --tolerance -1",
        "render room.obj -o a.png --tolerance nan",
        "render room.obj -o a.png --tolerance inf",
        "render room.obj -o a.png --tolerance 1px",
        "render room.obj -o a.png --tolerance 1 --kernel wald",
        "gen",
        "gen balls --size x",
        "gen balls --size -1",
        "info room.obj room.obj",
        "bench room.obj --rounds 0",
        "bench room.obj --builders --kernels",
        "bench room.obj --builders --builder spatial",
        "bench room.obj --layouts --builders",
        "bench room.obj --layouts --layout bvh4",
        "chart",
        "chart --from a.json --quick -o a.svg",
        "chart --rays 0 -o a.svg",
        "accuracy --rays many",
        "chart --from a.json",
        "chart --from -o a.svg",
    ] {
        let run = scratch.rt(&args.split_whitespace().collect::<Vec<_>>()).exits(2);
        assert!(run.stdout.is_empty(), "rt {args}");
        assert!(run.stderr.contains("Usage: rt") || run.stderr.contains("--help"), "rt {args}");
    }
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
}

#[test]
fn values_may_be_negative_and_glued_on() {
    let scratch = Scratch::with_room();
    let apart = scratch.png(&["room.obj", "-s", "9x9", "--eye", "-3,-1,-2", "--light", "-1,1,-3"]);
    let glued = scratch.png(&["room.obj", "-s9x9", "--eye=-3,-1,-2", "--light=-1,1,-3"]);
    assert!(apart == glued);
}

#[test]
fn pictures_that_cannot_be_are_refused_at_once() {
    let scratch = Scratch::with_room();
    for (flags, message) in [
        (&["-s", "4294967295x4294967295"][..], "4294967295x4294967295 pixels cannot be made"),
        (&["-s", "100000x100000"], "100000x100000 pixels cannot be made"),
        (&["-s", "1x4294967295"], "1x4294967295 pixels cannot be made"),
        (&["--eye", "1,1,1", "--target", "1,1,1"], "the camera looks nowhere"),
        (&["--eye", "0,5,0", "--target", "0,0,0"], "the camera looks nowhere"),
        (&["--up", "0,0,0"], "the camera looks nowhere"),
    ] {
        let args = [&["render", "room.obj", "-o", "a.png"], flags].concat();
        let run = scratch.rt(&args).exits(1);
        assert!(run.stderr.contains(message), "{}", run.stderr);
        assert_eq!(scratch.names(), ["room.mtl", "room.obj"], "{flags:?}");
    }
    // Extreme, but numbers all the same: a picture or a message, never a panic.
    for flags in [
        ["--eye", "1e38,1e38,1e38"],
        ["--target", "3e38,0,0"],
        ["--up", "1e-40,1e-40,0"],
        ["--fov", "1e-30"],
        ["--fov", "179.99999"],
        ["--light", "3e38,3e38,3e38,3e38,3e38,3e38"],
        ["--background", "3e38,0,0"],
    ] {
        let args = [&["render", "room.obj", "-o", "-", "-s", "9x9"], &flags[..]].concat();
        let run = scratch.rt(&args);
        assert!(run.code == 0 || run.code == 1, "{flags:?}: {}", run.stderr);
    }
}
