//! The date that files carry if one is asked for: `SOURCE_DATE_EPOCH`, seconds since 1970-01-01T00:00:00Z
//! (<https://reproducible-builds.org/specs/source-date-epoch/>). Without it files carry none: the same model gives the same
//! file, and no date is invented.

use zip::DateTime;

/// Name of the environment variable.
pub const VARIABLE: &str = "SOURCE_DATE_EPOCH";

/// A moment, UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Date {
    year: u16,
    month: u8,
    day: u8,
    second_of_day: u32,
}

impl Date {
    /// The moment that the environment variable gives, if it is set.
    ///
    /// # Errors
    /// It gives something other than a time from 1980 to 2107, the years that archives know.
    pub fn asked_for() -> Result<Option<Self>, String> {
        let Some(value) = std::env::var_os(VARIABLE).filter(|value| !value.is_empty()) else { return Ok(None) };
        let seconds = value.to_str().and_then(|text| text.parse().ok());
        let date = seconds.and_then(Self::from_epoch);
        let wrong = || format!("{VARIABLE} is {value:?}; it must be a time in seconds since 1970, from 1980 to 2107");
        date.ok_or_else(wrong).map(Some)
    }

    /// The moment so many seconds after 1970-01-01T00:00:00Z; nothing before 1980 and after 2107.
    pub fn from_epoch(seconds: u64) -> Option<Self> {
        const DAY: u64 = 24 * 3600;
        // Days since 0000-03-01, so that the leap day ends a year; an era is 400 years.
        let days = seconds / DAY + 719_468;
        let (era, day_of_era) = (days / 146_097, days % 146_097);
        let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let month_from_march = (5 * day_of_year + 2) / 153;
        let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
        let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
        let year = year_of_era + 400 * era + u64::from(month <= 2);
        let year = u16::try_from(year).ok().filter(|year| (1980..=2107).contains(year))?;
        Some(Self { year, month: month as u8, day: day as u8, second_of_day: (seconds % DAY) as u32 })
    }

    fn time(self) -> (u32, u32, u32) {
        (self.second_of_day / 3600, self.second_of_day / 60 % 60, self.second_of_day % 60)
    }

    /// As XML has it: `2026-01-31T12:00:00Z`.
    pub fn text(self) -> String {
        let (hour, minute, second) = self.time();
        format!("{:04}-{:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z", self.year, self.month, self.day)
    }

    /// As archives have it, to two seconds.
    pub fn of_entry(self) -> DateTime {
        let (hour, minute, second) = self.time();
        let date =
            DateTime::from_date_and_time(self.year, self.month, self.day, hour as u8, minute as u8, second as u8);
        date.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_become_the_dates_of_the_calendar() {
        // By `date -u -d @SECONDS +%FT%TZ` of GNU coreutils.
        for (seconds, text) in [
            (315_532_800, "1980-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_709_210_096, "2024-02-29T12:34:56Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (4_354_819_199, "2107-12-31T23:59:59Z"),
        ] {
            assert_eq!(Date::from_epoch(seconds).map(Date::text).as_deref(), Some(text));
        }
        assert_eq!([0, 315_532_799, 4_354_819_200, u64::MAX].map(Date::from_epoch), [None; 4]);
    }
}
