//! `taceva-wire`: the simulated bench behind sockets, until it is interrupted or its standard input ends.

use std::io::Read;
use std::net::Ipv4Addr;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use taceva_sim::Model;
use taceva_wire::{BenchOptions, ForceKind, RobotKind, ServeOptions, Served, WireError};

/// Serves a simulated gel behind the sockets of devices that exist: a robot, a force transducer and a camera. Nothing is real; everything
/// listens on loopback alone.
#[derive(Debug, Parser)]
#[command(name = "taceva-wire", version)]
struct Arguments {
    /// The robot over the gel.
    #[arg(long, value_enum, default_value_t = RobotKind::Xarm)]
    robot: RobotKind,
    /// What measures the force.
    #[arg(long, value_enum, default_value_t = ForceKind::Sri)]
    force: ForceKind,
    /// The gel: vitactip, magictac, gelsight or gelsight-wm.
    #[arg(long, default_value = "gelsight", value_parser = model)]
    model: Model,
    /// The seed of every random error.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Pixels of the camera, along x and along y, that make one of a frame.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=64))]
    reduction: u32,
    /// Nothing errs, drifts or relaxes, as with `quiet` of the simulated sensors, and pictures lose nothing: for comparisons with a study that is
    /// simulated in the program.
    #[arg(long)]
    quiet: bool,
    /// Stream PNG, which is lossless.
    #[arg(long)]
    png: bool,
    /// The address of loopback to listen on.
    #[arg(long, default_value_t = Ipv4Addr::LOCALHOST)]
    host: Ipv4Addr,
    /// Listen on the ports that public clients expect (502, 30001 to 30003, 4008), and not on any free ones.
    #[arg(long)]
    usual_ports: bool,
    /// The version of its firmware that the controller reports.
    #[arg(long, default_value = "2.7.0", value_parser = firmware)]
    firmware: Firmware,
    /// Where to write the rig file.
    #[arg(long)]
    write: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug)]
struct Firmware([u32; 3]);

fn model(key: &str) -> Result<Model, String> {
    let known = || Model::ALL.map(Model::key).join(", ");
    Model::from_key(key).ok_or_else(|| format!("expected one of {}", known()))
}

fn firmware(text: &str) -> Result<Firmware, String> {
    let numbers: Result<Vec<u32>, _> = text.split('.').map(str::parse).collect();
    match numbers.as_deref() {
        Ok(&[major, minor, revision]) => Ok(Firmware([major, minor, revision])),
        _ => Err("expected three numbers such as 2.7.0".to_owned()),
    }
}

#[expect(clippy::print_stderr, reason = "a program says why it ends")]
fn main() -> ExitCode {
    match serve(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

#[expect(clippy::print_stdout, reason = "a program says where it listens")]
fn serve(arguments: &Arguments) -> Result<(), WireError> {
    let served = Served::start(&ServeOptions {
        bench: BenchOptions {
            model: arguments.model,
            seed: arguments.seed,
            is_quiet: arguments.quiet,
            reduction: arguments.reduction,
        },
        robot: arguments.robot,
        force: arguments.force,
        host: arguments.host,
        uses_usual_ports: arguments.usual_ports,
        firmware: arguments.firmware.0,
        is_lossless: arguments.png || arguments.quiet,
    })?;
    print!("{}", served.rig_file());
    if let Some(path) = &arguments.write {
        served.write_rig_file(path)?;
        println!("\n# written to {}", path.display());
    }
    println!("# It runs until it is interrupted, or its standard input ends.");
    // What comes there means nothing; that it ends does.
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
    Ok(())
}
