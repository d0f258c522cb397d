"""What the commands sweep, ablation and pictures share."""
