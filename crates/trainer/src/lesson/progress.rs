//! Which steps somebody has done: kept by the browser, and in a small file.

use std::collections::BTreeMap;

/// The first line of the file.
const HEAD: &str = "Buslens: lessons that are done";

/// More lessons and steps nobody has.
const MOST: usize = 1_000;

/// The steps that are done, by the keys of their lessons, counted from 1.
///
/// ```
/// use buslens_trainer::lesson::Progress;
///
/// let mut progress = Progress::default();
/// progress.finish("crc", 2);
/// assert_eq!(progress.write(), "Buslens: lessons that are done\ncrc: 2\n");
/// assert_eq!(Progress::read(&progress.write()), Some(progress));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    done: BTreeMap<String, Vec<usize>>,
}

impl Progress {
    pub fn is_empty(&self) -> bool {
        self.done.is_empty()
    }

    /// Whether the step is done.
    pub fn holds(&self, lesson: &str, step: usize) -> bool {
        self.done.get(lesson).is_some_and(|steps| steps.contains(&step))
    }

    /// How many steps of a lesson of so many steps are done.
    pub fn count(&self, lesson: &str, steps: usize) -> usize {
        self.done.get(lesson).map_or(0, |done| done.iter().filter(|step| (1..=steps).contains(*step)).count())
    }

    /// The step is done.
    pub fn finish(&mut self, lesson: &str, step: usize) {
        let steps = self.done.entry(lesson.to_owned()).or_default();
        if let Err(at) = steps.binary_search(&step) {
            steps.insert(at, step);
        }
    }

    /// Takes what another one has, too.
    pub fn join(&mut self, other: &Self) {
        for (lesson, steps) in &other.done {
            for step in steps {
                self.finish(lesson, *step);
            }
        }
    }

    /// As a file has it.
    pub fn write(&self) -> String {
        let mut text = format!("{HEAD}\n");
        for (lesson, steps) in &self.done {
            let steps: Vec<String> = steps.iter().map(usize::to_string).collect();
            text += &format!("{lesson}: {}\n", steps.join(" "));
        }
        text
    }

    /// What [`write`](Self::write) wrote; `None` if the text is something else. Lines that are none of it
    /// are passed over: another version may have written them.
    pub fn read(text: &str) -> Option<Self> {
        let mut lines = text.trim_start_matches('\u{feff}').lines();
        if lines.next()?.trim() != HEAD {
            return None;
        }
        let mut progress = Self::default();
        for (lesson, steps) in lines.take(MOST).filter_map(|line| line.split_once(':')) {
            let steps = steps.split_whitespace().take(MOST).filter_map(|step| step.parse().ok());
            for step in steps.filter(|step| (1..=MOST).contains(step)) {
                progress.finish(lesson.trim(), step);
            }
        }
        Some(progress)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_of_them_are_joined() {
        let mut one = Progress::read("Buslens: lessons that are done\r\ncrc: 2 1 2\nbytes: 1\n").unwrap();
        let other = Progress::read(&format!("{HEAD}\ncrc: 3 x -1 0\nnonsense\n")).unwrap();
        one.join(&other);
        assert_eq!(one.write(), format!("{HEAD}\nbytes: 1\ncrc: 1 2 3\n"));
        assert_eq!((one.count("crc", 2), one.count("crc", 9), one.count("none", 9)), (2, 3, 0));
        assert!(one.holds("crc", 3) && !one.holds("crc", 4));
    }

    #[test]
    fn other_files_are_none() {
        assert_eq!(Progress::read(""), None);
        assert_eq!(Progress::read("# Bytes and hex\nkey: bytes"), None);
    }
}
