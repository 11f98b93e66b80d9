//! Draws every figure of a result: `cargo run -p taceva-report --example draw -- RESULT.json FOLDER`, with samples from `RESULT.samples.csv`.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use taceva_report::{Samples, Study, figures};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(result), Some(folder)) = (arguments.next(), arguments.next()) else {
        return Err("expected RESULT.json FOLDER".into());
    };
    let mut studies = Study::read(&fs::read_to_string(&result)?)?;
    let samples = result.with_extension("samples.csv");
    if let ([study], true) = (studies.as_mut_slice(), samples.is_file()) {
        study.samples = Some(Samples::read(&fs::read_to_string(samples)?)?);
    }
    fs::create_dir_all(&folder)?;
    for figure in figures(&studies) {
        let path = folder.join(&figure.id);
        fs::write(path.with_extension("svg"), figure.svg())?;
        fs::write(path.with_extension("pdf"), figure.pdf())?;
    }
    Ok(())
}
