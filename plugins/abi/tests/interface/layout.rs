//! The Rust mirror equals the C headers: every size, offset and constant, compiled as C11 and C++17. Both equal the frozen values in `layout.txt`.

// The frozen values are for 64-bit pointers.
#![cfg(target_pointer_width = "64")]

use std::fmt::Write as _;
use std::fs;
use std::mem::{offset_of, size_of};
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_needs::{Need, skip};

use taceva_abi::ext::{
    BENCH, BenchCalls, EXPIRING_MOTION, ExpiringMotionCalls, GUARDED_MOTION, GuardedMotionCalls,
    GuardedStop, NUMBERED, NumberedCalls, SENSOR_LIGHTING, SensorLightingCalls, Specimen, TARE,
    TareCalls,
};
use taceva_abi::{
    ABI_MAJOR, ABI_MINOR, Arg, Args, CHANGER_FACTORY, ChangerCalls, Device, DeviceCalls,
    ENTRY_SYMBOL, ESTIMATOR_FACTORY, Error, EstimatorFactory, FORCE_FACTORY, FRAME_DROPPED,
    FRAME_NUMBERED, Factory, FaultNumber, ForceCalls, Frame, Host, LIGHTING_FACTORY, Level,
    LightingCalls, MAGIC, MESSAGE_SIZE, Motion, PixelFormat, Plugin, Pose, ROBOT_FACTORY,
    Regressor, RegressorCalls, RobotCalls, SENSOR_FACTORY, SensorCalls, Stamp, Status, Text,
    TrainingSet, Wrench,
};

/// A C expression, and its value in Rust.
type Line = (String, i64);

fn line(c: String, rust: impl TryInto<i64>) -> Line {
    let rust = rust.try_into().ok().expect("small numbers");
    (c, rust)
}

/// Lists the size of each struct and the offsets of all its fields.
macro_rules! structs {
    ($($c:ident = $rust:ident { $($field:ident),* $(,)? })*) => {{
        let mut lines = Vec::new();
        $(
            lines.push(line(format!("sizeof({})", stringify!($c)), size_of::<$rust>()));
            $(
                let c = format!("offsetof({}, {})", stringify!($c), stringify!($field));
                lines.push(line(c, offset_of!($rust, $field)));
            )*
            // Does not compile if the list lacks a field.
            let _ = |it: $rust| { let $rust { $($field: _),* } = it; };
        )*
        lines
    }};
}

fn sizes_and_offsets() -> Vec<Line> {
    structs! {
        taceva_text = Text { data, length }
        taceva_error = Error { size, vendor_code, message, fault }
        taceva_arg = Arg { key, text, whole, number, kind, reserved }
        taceva_args = Args { items, count }
        taceva_host = Host { size, abi_minor, context, log, now_ns }
        taceva_stamp = Stamp { valid_ns, received_ns }
        taceva_device_calls = DeviceCalls { size, reserved, close, interrupt, extension }
        taceva_device = Device { handle, calls }
        taceva_factory = Factory { size, drivers, describe, discover, open }
        taceva_plugin = Plugin {
            magic, size, abi_major, abi_minor, id, version, init, deinit, factory, open_rig, close_rig, rig_extension,
            needs,
        }
        taceva_frame = Frame {
            size, format, width, height, flags, reserved, sequence, stamp, buffer, buffer_length, data, length, release,
            private_data,
        }
        taceva_sensor_calls = SensorCalls { device, max_lent, reserved, start, capture, stop }
        taceva_pose = Pose { x, y, z, qw, qx, qy, qz }
        taceva_motion = Motion { size, reserved, target, speed_m_per_s }
        taceva_robot_calls = RobotCalls { device, pose, move_to, wait, halt, clear_halt }
        taceva_wrench = Wrench { force_n, torque_n_mm }
        taceva_force_calls = ForceCalls { device, start, read, stop, lost }
        taceva_lighting_calls = LightingCalls { device, set }
        taceva_changer_calls = ChangerCalls { device, bring }
        taceva_training_set = TrainingSet {
            size, channels, samples, height, width, depth, reserved, features, targets, groups, channel_names,
        }
        taceva_regressor_calls = RegressorCalls { size, reserved, close, predict, save }
        taceva_regressor = Regressor { handle, calls }
        taceva_estimator_factory = EstimatorFactory { size, estimators, describe, fit, load }
        taceva_tare_calls = TareCalls { size, reserved, zero }
        taceva_numbered_calls = NumberedCalls { size, reserved, sequence }
        taceva_guarded_stop = GuardedStop { size, is_guarded, pose, stamp }
        taceva_guarded_motion_calls = GuardedMotionCalls { size, reserved, move_guarded }
        taceva_expiring_motion_calls = ExpiringMotionCalls { size, reserved, move_expiring }
        taceva_sensor_lighting_calls = SensorLightingCalls { size, reserved, set }
        taceva_specimen = Specimen { size, kind, size_nm }
        taceva_bench_calls = BenchCalls { size, reserved, now_ns, rest, mount, name_press, schedule, provenance }
    }
}

fn constants() -> Vec<Line> {
    let mut lines: Vec<Line> = [
        ("TACEVA_MAGIC", MAGIC),
        ("TACEVA_ABI_MAJOR", ABI_MAJOR),
        ("TACEVA_ABI_MINOR", ABI_MINOR),
        ("TACEVA_ARG_TEXT", Arg::TEXT),
        ("TACEVA_ARG_WHOLE", Arg::WHOLE),
        ("TACEVA_ARG_NUMBER", Arg::NUMBER),
        ("TACEVA_ARG_FLAG", Arg::FLAG),
        ("TACEVA_GRAY8", PixelFormat::GRAY8.0),
        ("TACEVA_GRAY16", PixelFormat::GRAY16.0),
        ("TACEVA_RGB8", PixelFormat::RGB8.0),
        ("TACEVA_RGB16", PixelFormat::RGB16.0),
        ("TACEVA_FRAME_DROPPED", FRAME_DROPPED),
        ("TACEVA_FRAME_NUMBERED", FRAME_NUMBERED),
        ("TACEVA_SPECIMEN_SPHERE", Specimen::SPHERE),
        ("TACEVA_SPECIMEN_LINE", Specimen::LINE),
        ("TACEVA_SPECIMEN_DOT", Specimen::DOT),
    ]
    .map(|(c, rust)| line(c.to_owned(), rust))
    .into();
    lines.push(line("TACEVA_MESSAGE_SIZE".to_owned(), MESSAGE_SIZE));
    lines.extend(
        [
            ("TACEVA_LOG_ERROR", Level::Error),
            ("TACEVA_LOG_WARN", Level::Warn),
            ("TACEVA_LOG_INFO", Level::Info),
            ("TACEVA_LOG_DEBUG", Level::Debug),
        ]
        .map(|(c, rust)| line(c.to_owned(), rust as i32)),
    );
    lines.extend(
        [
            ("TACEVA_FAULT_NONE", FaultNumber::NONE),
            ("TACEVA_FAULT_EMERGENCY_STOP", FaultNumber::EMERGENCY_STOP),
            ("TACEVA_FAULT_COLLISION", FaultNumber::COLLISION),
            ("TACEVA_FAULT_BOUNDARY", FaultNumber::BOUNDARY),
            ("TACEVA_FAULT_SERVO", FaultNumber::SERVO),
        ]
        .map(|(c, rust)| line(c.to_owned(), rust.0)),
    );
    lines.push(line(
        "TACEVA_ERROR_SIZE".to_owned(),
        offset_of!(Error, fault),
    ));
    lines.extend(
        [
            ("TACEVA_OK", Status::OK),
            ("TACEVA_NOT_FOUND", Status::NOT_FOUND),
            ("TACEVA_PERMISSION_DENIED", Status::PERMISSION_DENIED),
            ("TACEVA_BUSY", Status::BUSY),
            ("TACEVA_TIMEOUT", Status::TIMEOUT),
            ("TACEVA_DISCONNECTED", Status::DISCONNECTED),
            ("TACEVA_UNSUPPORTED", Status::UNSUPPORTED),
            ("TACEVA_INVALID_ARGUMENT", Status::INVALID_ARGUMENT),
            ("TACEVA_PROTOCOL", Status::PROTOCOL),
            ("TACEVA_OUT_OF_RANGE", Status::OUT_OF_RANGE),
            ("TACEVA_INTERRUPTED", Status::INTERRUPTED),
            ("TACEVA_DEVICE_FAULT", Status::DEVICE_FAULT),
            ("TACEVA_ABI", Status::ABI),
            ("TACEVA_END_OF_STREAM", Status::END_OF_STREAM),
            ("TACEVA_PANICKED", Status::PANICKED),
            ("TACEVA_INTERNAL", Status::INTERNAL),
        ]
        .map(|(c, rust)| line(c.to_owned(), rust.0)),
    );
    lines
}

/// String constants: ids that the C compiler compares with the values in Rust.
fn texts() -> Vec<(&'static str, &'static str)> {
    vec![
        ("TACEVA_SENSOR_FACTORY", SENSOR_FACTORY),
        ("TACEVA_ROBOT_FACTORY", ROBOT_FACTORY),
        ("TACEVA_FORCE_FACTORY", FORCE_FACTORY),
        ("TACEVA_LIGHTING_FACTORY", LIGHTING_FACTORY),
        ("TACEVA_CHANGER_FACTORY", CHANGER_FACTORY),
        ("TACEVA_ESTIMATOR_FACTORY", ESTIMATOR_FACTORY),
        ("TACEVA_TARE", TARE),
        ("TACEVA_NUMBERED", NUMBERED),
        ("TACEVA_GUARDED_MOTION", GUARDED_MOTION),
        ("TACEVA_EXPIRING_MOTION", EXPIRING_MOTION),
        ("TACEVA_SENSOR_LIGHTING", SENSOR_LIGHTING),
        ("TACEVA_BENCH", BENCH),
    ]
}

/// Values of all constants, sizes and offsets in Rust, one per line.
fn mirrored() -> String {
    let mut out = String::new();
    for (c, rust) in sizes_and_offsets().into_iter().chain(constants()) {
        writeln!(out, "{c} = {rust}").expect("writing to a string does not fail");
    }
    for (name, text) in texts() {
        writeln!(out, "{name} = \"{text}\"").expect("writing to a string does not fail");
    }
    out
}

/// C program that prints the same lines from the headers.
fn program() -> String {
    let mut out = String::from("#include <stdio.h>\n");
    for header in headers() {
        writeln!(out, "#include <taceva/{header}>").expect("writing to a string does not fail");
    }
    out.push_str("int main(void) {\n");
    for (c, _) in sizes_and_offsets().into_iter().chain(constants()) {
        writeln!(out, "  printf(\"{c} = %lld\\n\", (long long)({c}));").expect("room");
    }
    for (name, _) in texts() {
        writeln!(out, "  printf(\"{name} = \\\"%s\\\"\\n\", {name});").expect("room");
    }
    out.push_str("  return 0;\n}\n");
    out
}

fn include() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("include")
}

/// Names of all C headers. Headers for C++ only are excluded, because they declare no types of the interface.
fn headers() -> Vec<String> {
    let root = include().join("taceva");
    let mut folders = vec![root.clone()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the folder of the headers") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "h") {
                let name = path.strip_prefix(&root).expect("below it");
                found.push(name.to_string_lossy().into_owned());
            }
        }
    }
    found.sort();
    assert!(found.len() >= 9, "{found:?}");
    found
}

/// A compiler and its arguments.
struct Compiler {
    program: String,
    need: Need,
    language: [&'static str; 3],
    file: &'static str,
}

fn compilers() -> [Compiler; 2] {
    let named = |variable: &str, default: &str| std::env::var(variable).unwrap_or(default.into());
    [
        Compiler {
            program: named("CC", "cc"),
            need: Need::CCompiler,
            language: ["-std=c11", "-x", "c"],
            file: "layout.c",
        },
        Compiler {
            program: named("CXX", "c++"),
            need: Need::CppCompiler,
            language: ["-std=c++17", "-x", "c++"],
            file: "layout.cpp",
        },
    ]
}

const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];

/// Compiles `source`. Without a compiler, prints the reason and returns `None`.
fn compile(compiler: &Compiler, source: &str, folder: &Path, extra: &[&str]) -> Option<PathBuf> {
    let file = folder.join(compiler.file);
    let built = folder.join(format!("{}.out", compiler.file));
    fs::write(&file, source).expect("write the source");
    let output = Command::new(&compiler.program)
        .args(compiler.language)
        .args(STRICT)
        .arg("-I")
        .arg(include())
        .args(extra)
        .arg(&file)
        .arg("-o")
        .arg(&built)
        .output();
    let output = match output {
        Ok(output) => output,
        Err(error) => {
            skip(compiler.need, format!("`{}`: {error}", compiler.program));
            return None;
        }
    };
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {said}", compiler.program);
    Some(built)
}

#[test]
fn sizes_offsets_and_constants_of_the_headers_equal_the_mirror_in_c11_and_cpp17() {
    let folder = tempfile::tempdir().expect("a folder");
    for compiler in compilers() {
        let Some(built) = compile(&compiler, &program(), folder.path(), &[]) else {
            continue;
        };
        let output = Command::new(built).output().expect("run it");
        let c = String::from_utf8(output.stdout).expect("text");
        for (c, rust) in c.lines().zip(mirrored().lines()) {
            assert_eq!(c, rust, "{}", compiler.file);
        }
        assert_eq!(c, mirrored(), "{}", compiler.file);
    }
}

#[test]
fn every_header_compiles_alone_in_c11_and_cpp17() {
    let folder = tempfile::tempdir().expect("a folder");
    for compiler in compilers() {
        for header in headers() {
            let source = format!("#include <taceva/{header}>\n");
            compile(&compiler, &source, folder.path(), &["-c"]);
        }
    }
}

#[test]
fn nothing_of_the_frozen_layout_has_changed() {
    let frozen = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/layout.txt");
    if std::env::var_os("TACEVA_BLESS").is_some() {
        fs::write(&frozen, mirrored()).expect("write the layout");
    }
    let frozen = fs::read_to_string(&frozen).expect("the frozen layout");
    assert_eq!(
        mirrored(),
        frozen,
        "the layout is frozen: see ABI.md for what may change, and how"
    );
}

#[test]
fn the_symbol_is_the_one_that_the_header_names() {
    let header = fs::read_to_string(include().join("taceva/plugin.h")).expect("the header");
    let symbol = ENTRY_SYMBOL.to_str().expect("plain");
    assert!(header.contains(&format!("extern const taceva_plugin {symbol};")));
}
