//! The script of a Slurm array that computes a plan, a shard a task.

/// What the script has to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Array<'a> {
    /// The program.
    pub program: &'a str,
    /// The campaign's folder.
    pub folder: &'a str,
    /// Number of tasks.
    pub tasks: usize,
    /// Time a task may take, minutes.
    pub minutes: u64,
}

impl Array<'_> {
    /// The script's text. It is submitted again as it is until all tasks have ended with 0: what is done is not done again.
    pub fn script(&self) -> String {
        let Self { program, folder, tasks, minutes } = self;
        let (program, folder) = (quoted(program), quoted(folder));
        format!(
            "#!/bin/bash\n\
             #SBATCH --job-name=ttb-campaign\n\
             #SBATCH --array=0-{last}\n\
             #SBATCH --ntasks=1\n\
             #SBATCH --cpus-per-task=1\n\
             #SBATCH --time={minutes}\n\
             # A task that Slurm ends (SIGTERM) keeps the runs it has done. Submit the script again: it does the rest.\n\
             exec {program} campaign {folder}/plan.json -o {folder} --shard \"$SLURM_ARRAY_TASK_ID/{tasks}\" \
             -j \"${{SLURM_CPUS_PER_TASK:-1}}\" --quiet\n",
            last = tasks - 1
        )
    }
}

/// A word for the shell.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) { word.into() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_with_spaces_and_quotes_stay_one_word() {
        assert_eq!(quoted("/a/b.json"), "/a/b.json");
        assert_eq!(quoted("my bridge"), "'my bridge'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        let script = Array { program: "ttb", folder: "my out", tasks: 8, minutes: 30 }.script();
        assert!(script.contains("--array=0-7") && script.contains("'my out'/plan.json"), "{script}");
    }
}
