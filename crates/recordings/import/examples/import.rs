//! Imports a folder by a map: `import SOURCE MAP.toml TARGET`.
#![expect(clippy::print_stdout, reason = "an example talks to a person")]

use std::error::Error;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_import::{ImportMap, ImportPlan};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [source, map, target] = arguments.as_slice() else {
        return Err("usage: import SOURCE MAP.toml TARGET".into());
    };
    let map = ImportMap::read(Path::new(map))?;
    let plan = ImportPlan::new(Path::new(source), &map)?;
    let jobs = std::thread::available_parallelism()?;
    print!("{}", plan.run(Path::new(target), jobs, &SilentProgress)?);
    Ok(())
}
