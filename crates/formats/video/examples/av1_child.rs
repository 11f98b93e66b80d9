//! The whole of a program that decodes AV1 for its parent: what `Decoders::av1` may name.

use std::process::ExitCode;

fn main() -> ExitCode {
    match taceva_video::av1::serve(std::io::stdin().lock(), std::io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Its parent passes the last line on.
            drop(std::io::Write::write_all(
                &mut std::io::stderr(),
                format!("{error}\n").as_bytes(),
            ));
            ExitCode::FAILURE
        }
    }
}
