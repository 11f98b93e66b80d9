//! Draws every figure of a result: `cargo run -p taceva-report --example draw -- RESULT.json FOLDER`, with samples from `RESULT.samples.csv`. Draws run time
//! against error instead if the file is a benchmark of models.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_report::{Figure, ModelBench, Study, figures, model_bench};
use taceva_results::Samples;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(result), Some(folder)) = (arguments.next(), arguments.next()) else {
        return Err("expected RESULT.json FOLDER".into());
    };
    let drawn: Vec<Figure> = match ModelBench::read(&fs::read_to_string(&result)?) {
        Ok(bench) => model_bench(&bench).into_iter().collect(),
        Err(_) => figures(&studies(&result)?),
    };
    fs::create_dir_all(&folder)?;
    for figure in drawn {
        let path = folder.join(&figure.id);
        fs::write(path.with_extension("svg"), figure.svg())?;
        fs::write(path.with_extension("pdf"), figure.pdf())?;
    }
    Ok(())
}

/// Studies of a result, with samples from `RESULT.samples.csv`.
fn studies(result: &Path) -> Result<Vec<Study>, Box<dyn Error>> {
    let mut studies = Study::read(&fs::read_to_string(result)?)?;
    let samples = result.with_extension("samples.csv");
    if let ([study], true) = (studies.as_mut_slice(), samples.is_file()) {
        study.samples = Some(Samples::read(&fs::read_to_string(samples)?)?);
    }
    Ok(studies)
}
