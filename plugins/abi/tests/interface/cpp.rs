//! C++ helper tables convert every exception of a sensor to a status and a message, without a memory leak.

use std::path::Path;
use std::process::Command;

use taceva_needs::{Need, skip};

/// Expected output of the host in `cpp/sensor.cpp`: one line per call, with the status, the length of the message and its beginning.
const EXPECTED: &str = "\
well: 0 0 
2x1 of 4, 12 bytes to 9, picture 1 at 5
no device: -1 23 no camera is plugged in
no gain: -7 19 `gain` is not given
failure: -5 16 the cable is out
success: -15 29 a failure that claims success
exception: -15 10 row 7 of 3
memory: -15 14 std::bad_alloc
whatever: -15 37 the exception is not a std::exception
long: -15 502 xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx
stop throws: 0 0 
wait: -4 20 nothing came in time
well: -7 17 it is not started
well: -7 35 the buffer is too short for a frame
interrupted: -10 18 it was interrupted
third: -1 14 no such driver
key = \"second\"
others: 0
tiny: -1 3 no 
none: -1 3 no 
0 alive, 22 starts and stops
";

#[test]
fn whatever_a_sensor_in_cpp_throws_is_a_status_with_a_message() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let folder = tempfile::tempdir().expect("a folder");
    for level in ["-O0", "-O3"] {
        let program = folder.path().join(level);
        let built = Command::new(&compiler)
            .args(["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror"])
            .args([level, "-pthread", "-I"])
            .arg(here.join("include"))
            .arg(here.join("tests/cpp/sensor.cpp"))
            .arg("-o")
            .arg(&program)
            .output();
        let built = match built {
            Ok(built) => built,
            Err(error) => {
                skip(Need::CppCompiler, format!("`{compiler}`: {error}"));
                return;
            }
        };
        let said = String::from_utf8_lossy(&built.stderr);
        assert!(built.status.success(), "{level}: {said}");
        let run = Command::new(&program).output().expect("it was built");
        assert!(run.status.success(), "{level}: {:?}", run.status);
        assert_eq!(String::from_utf8_lossy(&run.stdout), EXPECTED, "{level}");
    }
}

#[test]
fn the_helpers_stay_small_enough_to_be_read_whole() {
    for header in [
        include_str!("../../include/taceva/device.hpp"),
        include_str!("../../include/taceva/sensor.hpp"),
        include_str!("../../include/taceva/force.hpp"),
        include_str!("../../include/taceva/robot.hpp"),
        include_str!("../../include/taceva/lighting.hpp"),
        include_str!("../../include/taceva/changer.hpp"),
    ] {
        assert!(header.lines().count() < 170);
    }
}
