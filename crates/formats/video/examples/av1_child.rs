//! Complete program that decodes AV1 for a parent process, for use as `Decoders::av1`.

use std::process::ExitCode;

fn main() -> ExitCode {
    match taceva_video::av1::serve(std::io::stdin().lock(), std::io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // The parent reports the last line.
            drop(std::io::Write::write_all(
                &mut std::io::stderr(),
                format!("{error}\n").as_bytes(),
            ));
            ExitCode::FAILURE
        }
    }
}
