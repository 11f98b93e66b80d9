//! `taceva accept`.

use std::fs;

use anyhow::Context as _;
use taceva_report::{Acceptance, LimitsFile, accept};

use super::{Context, Usage, results};
use crate::args::Accept;
use crate::{exit, output};

pub(crate) fn run(args: &Accept, _context: &Context) -> anyhow::Result<u8> {
    for path in args.output.path.iter().chain(&args.html) {
        output::check_free(path, args.output.force)?;
    }
    let text = fs::read_to_string(&args.limits)
        .with_context(|| format!("cannot read {}", args.limits.display()))?;
    let limits = LimitsFile::read(&text).with_context(|| args.limits.display().to_string())?;
    let studies = results::read(&args.result)?;
    let [study] = studies.as_slice() else {
        return Err(Usage::error(format!(
            "{}: {} sensors, expected the result of one",
            args.result.display(),
            studies.len()
        )));
    };
    let findings = accept(study, &limits);
    let acceptance = Acceptance {
        name: &limits.name,
        study,
        findings: &findings,
    };
    results::write(&acceptance.listing(), &args.output, || acceptance.json())?;
    if let Some(path) = &args.html {
        let page = acceptance.page();
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(match acceptance.is_passed() {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}
