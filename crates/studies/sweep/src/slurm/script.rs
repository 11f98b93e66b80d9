//! Job scripts that a user can read, keep and submit without this program.

use std::path::Path;

use taceva_dataset::internal::shell_word;

use crate::slurm_spec::SlurmSpec;

/// Settings that scripts share.
pub(super) struct Script<'a> {
    pub(super) root: &'a Path,
    pub(super) tasks: &'a Path,
    pub(super) program: &'a str,
    pub(super) spec: &'a SlurmSpec,
    /// Command-line options of the sweep.
    pub(super) options: &'a str,
}

impl Script<'_> {
    /// Script of a job array. Each job runs the tasks that one line of the file `NAME.blocks` lists.
    pub(super) fn array(&self, name: &str, jobs: usize, gres: Option<&str>) -> String {
        let most = self
            .spec
            .most_jobs
            .map_or_else(String::new, |most| format!("%{most}"));
        let mut text = self.head(name, "%A_%a");
        let mut line = |line: String| {
            text.push_str(&line);
            text.push('\n');
        };
        line(format!("#SBATCH --array=0-{}{most}", jobs - 1));
        line("#SBATCH --requeue".to_owned());
        let asked = [
            ("time", self.spec.time.as_deref()),
            ("mem", self.spec.memory.as_deref()),
            ("gres", gres),
        ];
        for (option, value) in asked {
            if let Some(value) = value {
                line(format!("#SBATCH --{option}={value}"));
            }
        }
        let cpus = self.spec.cpus.unwrap_or(1).max(1);
        line(format!("#SBATCH --cpus-per-task={cpus}"));
        text.push_str(&self.setup());
        let blocks = self.root.join(format!("slurm/{name}.blocks"));
        text.push_str(&format!(
            "blocks={}\n[ -r \"$blocks\" ] || {{ echo \"$blocks is not on $(hostname): the folder of the sweep is not shared with this \
             node\" >&2; exit 1; }}\n",
            shell_word(&blocks.to_string_lossy())
        ));
        text.push_str("block=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" \"$blocks\")\n");
        text.push_str(&format!(
            "exec {} sweep task {} --tasks {} --at \"$block\" --jobs {cpus} --quiet{}\n",
            shell_word(self.program),
            shell_word(&self.root.to_string_lossy()),
            shell_word(&self.tasks.to_string_lossy()),
            self.options
        ));
        text
    }

    /// Script of the job that collects the results. It starts after all other jobs have ended, with or without success.
    pub(super) fn collect(&self) -> String {
        let mut text = self.head("collect", "%j");
        text.push_str(&self.setup());
        text.push_str(&format!(
            "exec {} sweep collect {} --tasks {} --quiet\n",
            shell_word(self.program),
            shell_word(&self.root.to_string_lossy()),
            shell_word(&self.tasks.to_string_lossy())
        ));
        text
    }

    fn head(&self, name: &str, log: &str) -> String {
        let root = self.root.to_string_lossy();
        let mut text = format!(
            "#!/bin/bash\n# Written by `taceva sweep --on slurm`; it may be submitted again by hand: tasks with a result are \
             skipped.\n#SBATCH --job-name=taceva-{name}\n#SBATCH --chdir={root}\n#SBATCH \
             --output={root}/slurm/logs/{name}-{log}.txt\n#SBATCH --open-mode=append\n"
        );
        if let Some(partition) = &self.spec.partition {
            text.push_str(&format!("#SBATCH --partition={partition}\n"));
        }
        text
    }

    fn setup(&self) -> String {
        let lines = self.spec.setup.iter();
        lines.map(|line| format!("{line}\n")).collect()
    }
}
