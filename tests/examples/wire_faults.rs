//! Plays every fault of the wire bench TIMES times, 100 by default: `wire_faults [TIMES] [NAME]`; a name plays the cases that begin with it.
//!
//! `wire_faults TIMES kill` kills one study that many times instead.
//!
//! Ends with 1 if anything came of one that must not. What is printed is of this machine as busy as it is.
#![expect(clippy::print_stdout, reason = "it is run to be read")]

use std::error::Error;
use std::process::ExitCode;

use taceva_tests::wire::faults::{CASES, Outcome, play, play_kills};

const SEED: u64 = 20_261_123;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let times = arguments.next().map_or(Ok(100), |times| times.parse())?;
    let name = arguments.next().unwrap_or_default();
    if name == "kill" {
        let presses = play_kills(times, SEED)?;
        println!("killed {times} times: {presses} presses, each recorded once");
        return Ok(ExitCode::SUCCESS);
    }
    println!("| fault | times | studies | ended | in motion, median | most | allowed |");
    println!("|---|---|---|---|---|---|---|");
    let mut is_well = true;
    for case in CASES.iter().filter(|case| case.name.starts_with(&name)) {
        let result = play(case, times, SEED);
        let allowed = match case.outcome {
            Outcome::Stopped(most_ms) | Outcome::MayEnd(Some(most_ms)) => format!("{most_ms} ms"),
            Outcome::Unharmed | Outcome::MayEnd(None) => "–".to_owned(),
            Outcome::Left => "0 mm after".to_owned(),
        };
        println!(
            "| {} | {} | {} | {} | {:.1} ms | {:.1} ms | {allowed} |",
            case.name,
            result.times,
            result.studies,
            result.ended,
            result.median_ms(),
            result.most_ms()
        );
        for broken in &result.broken {
            println!("{broken}");
        }
        is_well &= result.broken.is_empty();
    }
    Ok(match is_well {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}
