"""Tables of states: which column means what, in which unit; CSV and Parquet read and written a piece at a time."""
