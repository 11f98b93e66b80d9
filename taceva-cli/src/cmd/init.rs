//! `taceva init`: writes initial files by questions with defaults.

mod answers;
mod interview;
mod recording;
mod rig;
mod scene;

use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::internal::quoted;

use super::{Context, Usage};
use crate::args::{Init, InitSubject, InitTarget};
use crate::{exit, output};
use interview::Interview;

pub(crate) fn run(args: &Init, context: &Context) -> anyhow::Result<u8> {
    let none = InitTarget::default();
    match &args.subject {
        Some(InitSubject::Recording(args)) => recording::write(
            &args.folder,
            &args.target,
            &mut Interview::new(&args.target),
        ),
        Some(InitSubject::Scene(target)) => {
            scene::write(target, &mut Interview::new(target), context)
        }
        Some(InitSubject::Rig(target)) => rig::write(target, &mut Interview::new(target), context),
        None => {
            let interview = &mut Interview::new(&none);
            let kinds = ["recording", "scene", "rig"];
            interview.say("recording: a folder of pictures and labels; scene: simulated sensors, no data needed; rig: your robot, transducer and camera");
            match interview
                .choose("what do you begin with", &kinds, Some("recording"))?
                .as_str()
            {
                "scene" => scene::write(&none, interview, context),
                "rig" => rig::write(&none, interview, context),
                _ => {
                    let is_there = |answer: &str| match Path::new(answer).exists() {
                        true => Ok(()),
                        false => Err(format!("{}: no such folder or file", shown(answer))),
                    };
                    let question = "the folder of the recording, or a file in it";
                    let source = interview.ask(question, None, is_there)?;
                    recording::write(Path::new(&source), &none, interview)
                }
            }
        }
    }
}

/// Path of the file to write: the named path or `default`. Fails for an existing file without `--force`.
fn target(args: &InitTarget, default: &str) -> anyhow::Result<PathBuf> {
    let path = args.path.clone().unwrap_or_else(|| PathBuf::from(default));
    output::check_free(&path, args.force)?;
    Ok(path)
}

/// Writes the file and prints the next commands.
fn finish(path: &Path, text: &str, next: &[String]) -> anyhow::Result<u8> {
    output::write(Some(path), |out| out.write_all(text.as_bytes()))?;
    output::write(None, |out| {
        writeln!(out, "wrote {}; next:", quoted(path))?;
        next.iter().try_for_each(|line| writeln!(out, "  {line}"))
    })?;
    Ok(exit::DONE)
}
